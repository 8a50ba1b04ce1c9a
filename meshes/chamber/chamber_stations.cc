#include "meshes/chamber/chamber_stations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "meshes/chamber/chamber_hot_spots.h"
#include "meshes/spacing/break_points.h"
#include "meshes/spacing/grading.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

void add_both_sides(BreakPoints& stations, double z_m, const std::string& what) {
  stations.add(-z_m, what + " at the back");
  stations.add(z_m, what + " at the front");
}

BreakPoints faces_along_z(const Chamber& chamber, const ChamberLayout& layout) {
  BreakPoints stations(layout.closest_m);
  add_both_sides(stations, 0.5 * chamber.tube.length_m, "the tube's end");
  add_both_sides(stations, layout.flange_begin_m, "the flange's inner face");
  for (const Plate& plate : layout.plates) {
    stations.add(plate.begin_m, "the back face of " + plate.name);
    stations.add(plate.end_m, "the front face of " + plate.name);
  }
  add_both_sides(stations, 0.5 * chamber.housing.length_m, "the housing's end");
  add_both_sides(stations, chamber.lugs.z_m - 0.5 * chamber.pads.size_z_m, "the pads' inner faces");
  add_both_sides(stations, chamber.lugs.z_m + 0.5 * chamber.pads.size_z_m, "the pads' outer faces");
  return stations;
}

BreakPoints edges_around(const ChamberLayout& layout) {
  BreakPoints arcs(layout.closest_m, 2 * pi * layout.tube_outer_m);
  for (const Plate& plate : layout.plates) {
    arcs.add(plate.first_rad * layout.tube_outer_m, "one edge of " + plate.name + " on the tube");
    arcs.add(plate.last_rad * layout.tube_outer_m, "the other edge of " + plate.name + " on the tube");
  }
  return arcs;
}

/// Where a lug covers its pad's corner one column of cells ends at the corner: it is to run along the strip.
void add_columns_to_corners(const ChamberLayout& layout, BreakPoints& arcs) {
  for (const FootLayout& foot : layout.feet) {
    const auto& offsets_m = foot.contact.offsets_m;
    if (offsets_m.size() < 3) continue;
    const double share = (offsets_m[1] - offsets_m[0]) / (offsets_m[2] - offsets_m[0]);
    const double half_m = layout.tube_outer_m * std::sin(0.5 * (foot.last_rad - foot.first_rad));
    const double angle_rad = foot.direction_rad + std::asin(half_m * (2 * share - 1) / layout.tube_outer_m);
    arcs.add_or_snap(angle_rad * layout.tube_outer_m);
  }
}

bool is_symmetrical(const std::vector<double>& ascending, double tolerance_m) {
  for (std::size_t i = 0; i < ascending.size(); ++i)
    if (std::abs(ascending[i] + ascending[ascending.size() - 1 - i]) > tolerance_m) return false;
  return true;
}

/// @param limit largest cell at a place, where it is below that of `size`
/// @param even  the interval in the middle has an even number of cells
std::vector<double> subdivide(const std::vector<double>& breaks, const AxialSize& size,
                              const std::function<double(double)>& limit, bool even) {
  std::vector<double> result = {breaks.front()};
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    AxialSize here = size;
    here.largest_m = std::min(size.largest_m, limit(0.5 * (breaks[i] + breaks[i + 1])));
    auto part = axial_stations(breaks[i], breaks[i + 1], here, 1);
    if (even && 2 * (i + 1) == breaks.size() && part.size() % 2 == 0)
      part = axial_stations(breaks[i], breaks[i + 1], here, int(part.size()));
    result.insert(result.end(), part.begin() + 1, part.end());
  }
  return result;
}

/// Largest cell around the tube where the webs' cells fan out to the housing: they shall not turn more there
/// than others.
double limit_at_web(const ChamberLayout& layout, double arc_m) {
  const WebLayout& web = layout.web;
  const double half_rad = 0.5 * (web.last_rad - web.first_rad);
  const double housing_half_rad = 0.5 * (web.housing_first_rad - web.housing_last_rad);
  const double from_middle_rad =
      std::remainder(arc_m / layout.tube_outer_m - 0.5 * (web.first_rad + web.last_rad), 2 * pi);
  return std::abs(from_middle_rad) < half_rad
             ? coarsest_turn_rad * layout.tube_outer_m * half_rad / housing_half_rad
             : std::numeric_limits<double>::infinity();
}

/// Largest cell around the tube under plates: its arc rises by a fifth of their first row's height at most,
/// or that row, whose other side is straight, would vanish in its middle.
double limit_under_plates(const ChamberLayout& layout, double arc_m) {
  constexpr double largest_rise = 0.2;  // a^2 / (8 R) of an arc of length a
  double limit_m = std::numeric_limits<double>::infinity();
  for (const Plate& plate : layout.plates) {
    const double from_middle_rad =
        std::remainder(arc_m / layout.tube_outer_m - 0.5 * (plate.first_rad + plate.last_rad), 2 * pi);
    if (std::abs(from_middle_rad) >= 0.5 * (plate.last_rad - plate.first_rad)) continue;
    const double row_m = layout.toe_size_within(plate.first_rad, plate.last_rad);
    limit_m = std::min(limit_m, std::sqrt(8 * layout.tube_outer_m * largest_rise * row_m));
  }
  return limit_m;
}

/// Stations that are symmetrical become so to the last bit.
void make_symmetrical(std::vector<double>& stations, double tolerance_m) {
  if (!is_symmetrical(stations, tolerance_m)) return;
  const std::size_t n = stations.size();
  for (std::size_t i = 0; 2 * i < n; ++i) {
    const double half_m = 0.5 * (stations[n - 1 - i] - stations[i]);
    stations[i] = -half_m;
    stations[n - 1 - i] = half_m;
  }
}

}  // namespace

std::vector<double> between_toes(double begin_m, double end_m, const ToeSizes& sizes, int n_min) {
  const AxialSize size{{{begin_m, sizes.begin_m}, {end_m, sizes.end_m}}, sizes.largest_m, sizes.growth};
  return axial_stations(begin_m, end_m, size, n_min);
}

ChamberStations place_stations(const Chamber& chamber, const ChamberLayout& layout,
                               const ChamberMeshControl& control) {
  BreakPoints z_breaks = faces_along_z(chamber, layout), arcs = edges_around(layout);
  add_columns_to_corners(layout, arcs);
  ChamberStations result;
  if (control.lean) {
    BreakPoints arcs_with_points = arcs, breaks_with_points = z_breaks;
    result.hot_spots = place_hot_spots(chamber, layout, arcs_with_points, breaks_with_points);
  } else {
    result.hot_spots = place_hot_spots(chamber, layout, arcs, z_breaks);
  }

  const double toe_m = layout.toe_size_m, period_m = 2 * pi * layout.tube_outer_m;
  AxialSize along{
      {{-layout.flange_begin_m, toe_m}, {layout.flange_begin_m, toe_m}}, layout.size_m, control.growth};
  AxialSize around{{}, layout.size_m, control.growth};
  for (const Plate& plate : layout.plates) {
    for (const double z_m : {plate.begin_m, plate.end_m})
      along.sources.push_back({z_m, layout.toe_size_at_z(z_m)});
    for (const double angle_rad : {plate.first_rad, plate.last_rad})
      for (const int turn : {-1, 0, 1, 2})
        around.sources.push_back({angle_rad * layout.tube_outer_m + turn * period_m,
                                  layout.toe_size_within(angle_rad, angle_rad)});
  }
  const auto unlimited = [](double) { return std::numeric_limits<double>::infinity(); };
  // A chamber that is symmetrical in z has cell faces in its middle: the solver then takes one half of it.
  const auto breaks_m = z_breaks.sorted();
  result.z_m = subdivide(breaks_m, along, unlimited, is_symmetrical(breaks_m, 0.01 * layout.closest_m));
  make_symmetrical(result.z_m, 0.01 * layout.closest_m);

  std::vector<double> closed = arcs.sorted();
  closed.push_back(closed.front() + period_m);
  const auto limit = [&](double arc_m) {
    return std::min(limit_at_web(layout, arc_m), limit_under_plates(layout, arc_m));
  };
  for (double arc_m : subdivide(closed, around, limit, false)) {
    if (arc_m >= period_m) arc_m -= period_m;
    result.angles_rad.push_back(arc_m / layout.tube_outer_m);
  }
  result.angles_rad.pop_back();  // the first again
  std::sort(result.angles_rad.begin(), result.angles_rad.end());
  return result;
}

}  // namespace meshes
