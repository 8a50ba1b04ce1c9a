#include <algorithm>
#include <cmath>

#include "meshes/checks/affordable.h"
#include "meshes/shaft/meridian.h"
#include "meshes/shaft/shaft_checks.h"
#include "meshes/shaft/shaft_layout.h"
#include "meshes/spacing/disc.h"

namespace meshes {

namespace {

/// Cells that follow the wanted size over a length: the integral of its reciprocal, each source by itself.
double n_cells_along(double length_m, const AxialSize& size) {
  double n = length_m / size.largest_m;
  for (const auto& source : size.sources)
    n += std::log1p(size.growth * length_m / source.size_m) / size.growth;
  return n;
}

double n_cells_of_fan(const Junction& junction, int n_sectors) {
  return 4.0 * junction.n_half_arc * std::max(0, junction.n_depth()) * n_sectors;
}

}  // namespace

double estimated_cells(const Shaft& shaft, const ShaftMeshControl& control) {
  const ShaftMeshControl before = before_subdivision(control);
  const ShaftLayout layout = lay_out(shaft, before);
  const auto n_of_core = double(build_disc(before.n_sectors, 1).quads.size());
  double n_cells = 0;
  for (std::size_t i = 0; i < layout.segments.size(); ++i) {
    const SegmentLayout& segment = layout.segments[i];
    const double n_in_section =
        double(segment.n_rows()) * before.n_sectors + (segment.is_bored() ? 0 : n_of_core);
    n_cells += n_in_section * n_cells_along(segment.column_end_m - segment.column_begin_m,
                                            axial_size(layout, int(i), before));
  }
  for (const Junction& junction : layout.junctions)
    if (junction.has_fan()) n_cells += n_cells_of_fan(junction, before.n_sectors);
  return n_cells * std::pow(control.subdivisions, 3);
}

void check_cells(const Shaft& shaft, const ShaftMeshControl& control) {
  const double n_cells = estimated_cells(shaft, control);
  ShaftMeshControl coarse = control;  // which key is it owed to?
  coarse.largest_cell_m = 0;
  const bool by_length = control.largest_cell_m > 0 && estimated_cells(shaft, coarse) < 0.5 * n_cells;
  require_affordable(n_cells, bytes_per_hexahedron, by_length ? "largest_cell_m" : "cells_per_fillet_quarter",
                     by_length ? "make it larger, or leave it out" : "take fewer, or fewer sectors");
}

}  // namespace meshes
