#include "meshes/solids/cell_estimate.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "meshes/values/constants.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

const double per_volume = 6 * std::sqrt(2.0);    // regular tetrahedra of edge 1 in a volume of 1
const double per_area = 3 * 4 / std::sqrt(3.0);  // three for each regular triangle of edge 1
constexpr double per_edge = 15;                  // around a curve with short edges

/// Largest curvature found at a few places of a surface; 0 where gmsh knows none.
double curvature_of(int surface) {
  std::vector<double> low, high, places, found;
  gmsh::model::getParametrizationBounds(2, surface, low, high);
  if (low.size() < 2 || high.size() < 2) return 0;
  for (const double u : {0.2, 0.5, 0.8})
    for (const double v : {0.2, 0.5, 0.8}) {
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

double estimated_cells(const SolidControl& control, double unit_m) {
  const double size = longest_edge(control, unit_m);
  gmsh::vectorpair volumes, surfaces;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::getEntities(surfaces, 2);
  double volume = 0, n_cells = 0;
  for (const auto& [dimension, tag] : volumes) volume += measure_of(dimension, tag);
  n_cells += per_volume * volume / std::pow(size, 3);
  for (const auto& [dimension, tag] : surfaces) {
    const double curvature = curvature_of(tag);
    const double curved = curvature > 0 ? 2 * pi / (control.cells_per_circle * curvature) : size;
    const double edge = std::min(size, std::max(curved, control.smallest_size_m / unit_m));
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
