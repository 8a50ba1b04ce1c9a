#include <algorithm>
#include <cmath>

#include "meshes/checks/affordable.h"
#include "meshes/shaft/meridian.h"
#include "meshes/shaft_layout/shaft_checks.h"
#include "meshes/shaft_layout/shaft_layout.h"
#include "meshes/spacing/disc.h"

namespace meshes {

namespace {

/// Cells that follow the wanted size in a segment's column: the integral of its reciprocal.
double n_cells_along(const SegmentLayout& segment, const AxialSize& size) {
  constexpr int n_samples = 1000;
  const double step_m = (segment.column_end_m - segment.column_begin_m) / n_samples;
  double n = 0;
  for (int i = 0; i < n_samples; ++i) n += step_m / size.at(segment.column_begin_m + (i + 0.5) * step_m);
  return std::max(1.0, n);
}

/// Number of cells of a fan in the meridian, without a core: the five blocks that fillet_fan.h draws.
double n_quads_of_fan(const Junction& junction, const ShaftLayout& layout) {
  const double n_half = junction.n_half_arc, n_depth = junction.n_depth();
  const double n_below = std::max(0.0, layout.segments[std::size_t(junction.small)].n_rows() - n_depth);
  const double n_above =
      std::max(0.0, layout.segments[std::size_t(junction.big)].n_rows() - n_below - n_half);
  return 2 * n_half * n_depth + n_half * n_below + n_depth * n_above;
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
    n_cells += n_in_section * n_cells_along(segment, axial_size(layout, int(i), before));
  }
  for (const Junction& junction : layout.junctions) {
    if (!junction.has_fan()) continue;
    n_cells += n_quads_of_fan(junction, layout) * before.n_sectors;
    if (!layout.segments[std::size_t(junction.small)].is_bored()) n_cells += junction.n_half_arc * n_of_core;
  }
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
