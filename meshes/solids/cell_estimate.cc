#include "meshes/solids/cell_estimate.h"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "meshes/values/constants.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

const double per_volume = 6 * std::sqrt(2.0);    // regular tetrahedra of edge 1 in a volume of 1
const double per_area = 3 * 4 / std::sqrt(3.0);  // three for each regular triangle of edge 1
constexpr double per_edge = 15;                  // around a curve with short edges

/// Largest curvature found at some places of a surface, by shares of its parameters' ranges; 0 where gmsh
/// knows none.
double curvature_of(int surface, const std::vector<double>& shares) {
  std::vector<double> low, high, places, found;
  gmsh::model::getParametrizationBounds(2, surface, low, high);
  if (low.size() < 2 || high.size() < 2) return 0;
  for (const double u : shares)
    for (const double v : shares) {
      places.push_back(low[0] + u * (high[0] - low[0]));
      places.push_back(low[1] + v * (high[1] - low[1]));
    }
  gmsh::model::getCurvature(2, surface, places, found);
  double largest = 0;
  for (const double curvature : found)
    if (std::isfinite(curvature)) largest = std::max(largest, std::abs(curvature));
  return largest;
}

}  // namespace

namespace {

[[noreturn]] void refuse_narrow(int surface, double width, double length) {
  std::ostringstream text;
  text.precision(3);
  text << "its surface " << surface << " is " << width << " wide and " << length
       << " long (mm, unless length_unit says otherwise), too narrow for cells: leave that chamfer, step or "
          "sliver out in CAD, or make it wider, and export again";
  throw GeometryRefused(text.str());
}

/// Where a side of a surface's parameters is one point, from which curvature falls off with the distance.
struct Tip {
  double slender = 0;  // height over radius, of an oval where it is sharpest; 0: no tip
  bool is_round = false;
  std::array<double, 3> at{};
};

/// Cones are written as splines too, and are ovals then.
/// @param fixed  which parameter is the same along the side: 0 or 1
Tip tip_at(int surface, int fixed, bool at_high) {
  constexpr double near = 1. / 48, far = 1. / 24, as_at_a_tip = 1.8;  // curvature at half the distance: twice
  constexpr double one_point = 1e-6;  // points this close, as a share of the distance, are one
  constexpr int n_around = 16;
  std::vector<double> low, high, places, points, curvature;
  gmsh::model::getParametrizationBounds(2, surface, low, high);
  if (low.size() < 2 || high.size() < 2) return {};
  const double end = at_high ? high[fixed] : low[fixed],
               along = at_high ? low[fixed] - high[fixed] : high[fixed] - low[fixed];
  for (int i = 0; i < n_around; ++i)
    for (const double share : {0., near, far}) {
      const double other = low[1 - fixed] + double(i) / n_around * (high[1 - fixed] - low[1 - fixed]);
      const double place = end + share * along;
      places.insert(places.end(), {fixed == 0 ? place : other, fixed == 0 ? other : place});
    }
  gmsh::model::getValue(2, surface, places, points);
  gmsh::model::getCurvature(2, surface, places, curvature);
  if (points.size() < 9 * n_around || curvature.size() < 3 * n_around) return {};
  const auto distance = [&](int i, int j) {
    return std::hypot(points[3 * j] - points[3 * i], points[3 * j + 1] - points[3 * i + 1],
                      points[3 * j + 2] - points[3 * i + 2]);
  };
  constexpr double round_within = 0.05;
  double least = std::numeric_limits<double>::max();
  Tip tip{0, false, {points[0], points[1], points[2]}};
  for (int i = 0; i < 3 * n_around; i += 3) {
    const double at_near = std::abs(curvature[i + 1]), at_far = std::abs(curvature[i + 2]);
    if (distance(0, i) > one_point * distance(i, i + 2)) return {};
    const double slender = at_near > as_at_a_tip * at_far ? at_far * distance(i, i + 2) : 0;
    tip.slender = std::max(tip.slender, slender);
    least = std::min(least, slender);
  }
  tip.is_round = least > (1 - round_within) * tip.slender;
  return tip;
}

}  // namespace

double measure_of(int dimension, int tag) {
  double value = 0;
  gmsh::model::occ::getMass(dimension, tag, value);
  return std::isfinite(value) ? std::abs(value) : 0;
}

std::map<int, double> sizes_along_narrow_surfaces(double smallest, double largest) {
  constexpr double widths = 8, most_edges = 3000, hopeless_widths = 100;
  std::map<int, double> most;
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto& surface : surfaces) {
    gmsh::vectorpair curves;
    gmsh::model::getBoundary({surface}, curves, false, false, false);
    double around = 0;
    for (const auto& curve : curves) around += measure_of(1, curve.second);
    const double width = around > 0 ? 2 * measure_of(2, surface.second) / around : 0;
    const double size = std::max(smallest, widths * width);
    if (width > 0 && around > most_edges * widths * width && largest > hopeless_widths * width)
      refuse_narrow(surface.second, width, around / 2);
    if (!(size > 0) || size >= largest || around > most_edges * size) continue;
    for (const auto& curve : curves) {
      const auto [known, is_new] = most.emplace(curve.second, size);
      if (!is_new) known->second = std::min(known->second, size);
    }
  }
  return most;
}

void refuse_slender_tips() {
  // Height over radius: of cones gmsh hung at 6 with three smallest sizes, at 4 with none; of round ones that
  // are splines at 4, 4.5 and 5.5, while it took 9 s at 3.5 and 4 s at 3; of ovals at 8.3, not at 5.6.
  constexpr double most_slender_cone = 5, most_slender_spline = 3.25, most_slender_oval = 6;
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto& surface : surfaces)
    for (const int fixed : {0, 1})
      for (const bool at_high : {false, true}) {
        const auto tip = tip_at(surface.second, fixed, at_high);
        std::string type;
        gmsh::model::getType(2, surface.second, type);
        const double most = type == "Cone" ? most_slender_cone
                            : tip.is_round ? most_slender_spline
                                           : most_slender_oval;
        if (!(tip.slender > most)) continue;
        std::ostringstream text;
        text.precision(3);
        text << "its surface " << surface.second << " comes to a tip"
             << (type == "Cone" ? " of " : ", somewhere as round as a cone's of ")
             << 2 * std::atan(1 / tip.slender) * 180 / pi << " degrees at (" << tip.at[0] << ", " << tip.at[1]
             << ", " << tip.at[2]
             << ") (mm, unless length_unit says otherwise), too slender for cells: cut the tip off flat "
                "in CAD, and export again";
        throw GeometryRefused(text.str());
      }
}

double smallest_edge(const SolidControl& control, double unit_m) {
  if (control.smallest_size_m > 0) return control.smallest_size_m / unit_m;
  // Edge length, as a share of the one that the sharpest curvature found asks for.
  constexpr double share = 0.25;
  constexpr double least = 1e-4, most = 0.25;  // limits of the edge length, as shares of the longest edge
  std::vector<double> shares;
  for (int i = 0; i < 12; ++i) shares.push_back((i + 0.5) / 12);
  const double longest = longest_edge(control, unit_m);
  double curvature = 0, shortest = most * longest;
  gmsh::vectorpair surfaces, curves;
  gmsh::model::getEntities(surfaces, 2);
  gmsh::model::getEntities(curves, 1);
  for (const auto& [dimension, tag] : surfaces) curvature = std::max(curvature, curvature_of(tag, shares));
  if (curvature > 0) shortest = std::min(shortest, share * 2 * pi / (control.cells_per_circle * curvature));
  for (const auto& [dimension, tag] : curves)
    if (const double length = measure_of(dimension, tag); length > least * longest)  // the others are points
      shortest = std::min(shortest, length);
  for (const auto& spot : control.fine_spots) shortest = std::min(shortest, spot.size_m / unit_m);
  for (const auto& [curve, edge] : sizes_along_narrow_surfaces(0, longest))
    shortest = std::min(shortest, edge);
  return std::max(shortest, least * longest);
}

double estimated_cells(const SolidControl& control, double unit_m) {
  const double size = longest_edge(control, unit_m), smallest = smallest_edge(control, unit_m);
  gmsh::vectorpair volumes, surfaces;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::getEntities(surfaces, 2);
  double volume = 0, n_cells = 0;
  for (const auto& [dimension, tag] : volumes) volume += measure_of(dimension, tag);
  n_cells += per_volume * volume / std::pow(size, 3);
  for (const auto& [dimension, tag] : surfaces) {
    const double curvature = curvature_of(tag, {0.2, 0.5, 0.8});
    const double curved = curvature > 0 ? 2 * pi / (control.cells_per_circle * curvature) : size;
    const double edge = std::min(size, std::max(curved, smallest));
    n_cells += per_area * measure_of(dimension, tag) / (edge * edge);
  }
  for (const auto& [curve, edge] : sizes_along_narrow_surfaces(control.smallest_size_m / unit_m, size))
    n_cells += per_edge * measure_of(1, curve) / edge;
  for (const auto& spot : control.fine_spots) {
    const double ball = 4 * pi / 3 * std::pow(spot.radius_m / unit_m, 3);
    n_cells += per_volume * std::min(volume, ball) / std::pow(std::min(size, spot.size_m / unit_m), 3);
  }
  return n_cells;
}

std::string control_of_cells(const SolidControl& control) {
  return control.size_m > 0 ? "size_m" : "cells_per_circle";
}

}  // namespace meshes
