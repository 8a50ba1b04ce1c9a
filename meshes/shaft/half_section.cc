#include "meshes/shaft/half_section.h"

#include <algorithm>

#include "meshes/shaft_layout/shaft_checks.h"
#include "meshes/shaft_layout/shaft_layout.h"
#include "meshes/shaft_layout/shaft_surfaces.h"

namespace meshes {

namespace {

/// The segment that a core cell lies in.
int segment_at(const ShaftLayout& layout, double z_m) {
  int i = 0;
  while (i + 1 < static_cast<int>(layout.segments.size()) && z_m > layout.segments[i].end_m) ++i;
  return i;
}

/// Rows from the core's radius down to the axis, and the two ends.
void fill_core(const CoreLine& core, const ShaftLayout& layout, int n_rows, HalfSection& half) {
  std::vector<int> previous;
  for (std::size_t s = 0; s < core.points.size(); ++s) {
    const double z_m = half.points[core.points[s]].z_m;
    std::vector<int> column = {core.points[s]};
    for (int k = 1; k <= n_rows; ++k) {
      column.push_back(static_cast<int>(half.points.size()));
      half.points.push_back({z_m, core.radius_m * (n_rows - k) / n_rows});
    }
    if (s > 0) {
      const int segment = segment_at(layout, 0.5 * (half.points[previous[0]].z_m + z_m));
      for (int k = 0; k < n_rows; ++k)
        half.quads.push_back({{previous[k + 1], column[k + 1], column[k], previous[k]}, segment});
    }
    for (int k = 0; k < n_rows; ++k) {
      if (s == 0) half.edges.push_back({{column[k], column[k + 1]}, core.begin_id});
      if (s + 1 == core.points.size()) half.edges.push_back({{column[k + 1], column[k]}, core.end_id});
    }
    previous = std::move(column);
  }
}

}  // namespace

HalfSection build_half_section(const Shaft& shaft, const ShaftMeshControl& control) {
  check_control(control);
  check_shaft(shaft);
  Shaft concentric = shaft;
  for (ShaftSegment& segment : concentric.segments) segment.eccentricity_m = 0;
  const ShaftMeshControl before = before_subdivision(control);
  const ShaftLayout layout = lay_out(concentric, before);
  const Meridian meridian = build_meridian(layout, name_surfaces(concentric, layout), before);
  HalfSection half{meridian.points, meridian.quads, meridian.edges};
  const int n = control.subdivisions, n_rows = n * std::max(n > 1 ? 1 : 2, before.n_sectors / 8);
  for (const CoreLine& core : meridian.cores) fill_core(core, layout, n_rows, half);
  return half;
}

}  // namespace meshes
