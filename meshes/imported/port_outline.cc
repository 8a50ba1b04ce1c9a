#include "meshes/imported/port_outline.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "meshes/solids/cad_surfaces.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

struct OutlinedSurface {
  CadSurface shape;
  Point low_m{}, high_m{};  ///< box around the curves that bound it
};

/// Six cells around a circle, the fewest, reach as far as this of its radius in the worst direction.
constexpr double coarse = 0.86;

OutlinedSurface outline_of(int surface, double unit_m) {
  constexpr int n_pieces = 32;
  OutlinedSurface outline;
  outline.shape = recognise(surface);
  outline.low_m.fill(std::numeric_limits<double>::max());
  outline.high_m.fill(-std::numeric_limits<double>::max());
  gmsh::vectorpair curves;
  gmsh::model::getBoundary({{2, surface}}, curves, false, false, false);
  for (const auto& curve : curves) {
    std::vector<double> begin, end, at;
    gmsh::model::getParametrizationBounds(1, curve.second, begin, end);
    for (int i = 0; i <= n_pieces && !begin.empty(); ++i) {
      gmsh::model::getValue(1, curve.second, {begin[0] + i * (end.at(0) - begin[0]) / n_pieces}, at);
      for (std::size_t d = 0; d < 3; ++d) {
        outline.low_m[d] = std::min(outline.low_m[d], unit_m * at.at(d));
        outline.high_m[d] = std::max(outline.high_m[d], unit_m * at.at(d));
      }
    }
  }
  return outline;
}

struct MayTake {
  const OutlinedSurface& surface;
  double unit_m;

  bool operator()(const GroupSelection&) const { return true; }

  bool operator()(const BoxSelection& box) const {
    for (std::size_t d = 0; d < 3; ++d) {
      const double middle_m = (surface.low_m[d] + surface.high_m[d]) / 2,
                   half_m = coarse * (surface.high_m[d] - surface.low_m[d]) / 2,
                   near_m = 1e-9 + 1e-6 * (box.high_m[d] - box.low_m[d]);
      if (middle_m - half_m < box.low_m[d] - near_m || middle_m + half_m > box.high_m[d] + near_m)
        return false;
    }
    return true;
  }

  /// Surfaces that are neither planes nor cylinders to the CAD may be cylinders to a mesh.
  bool operator()(const CylinderSelection& wanted) const {
    constexpr double near_share = 0.03, along_z = 1 - 1e-6;
    if (surface.shape.kind == CadSurface::Kind::plane) return false;
    if (!(surface.high_m[2] > wanted.begin_m && surface.low_m[2] < wanted.end_m)) return false;
    if (surface.shape.kind != CadSurface::Kind::cylinder) return true;
    const double off_m = std::hypot(unit_m * surface.shape.centre[0] - wanted.axis_x_m,
                                    unit_m * surface.shape.centre[1] - wanted.axis_y_m) +
                         std::abs(unit_m * surface.shape.radius - wanted.radius_m);
    return std::abs(surface.shape.axis[2]) > along_z && off_m <= near_share * wanted.radius_m;
  }
};

}  // namespace

void require_surfaces_of_ports(const std::vector<ImportPort>& ports, double unit_m) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 2);
  std::vector<OutlinedSurface> surfaces;
  for (const auto& entity : entities) surfaces.push_back(outline_of(entity.second, unit_m));
  for (const auto& port : ports)
    if (std::none_of(surfaces.begin(), surfaces.end(), [&](const auto& surface) {
          return std::visit(MayTake{surface, unit_m}, port.selection);
        }))
      throw GeometryRefused(
          "port " + port.name + ": no surface of the part lies " +
          (std::holds_alternative<BoxSelection>(port.selection) ? "in its box" : "on its cylinder") +
          "; `millstress ports` lists the surfaces that there are");
}

}  // namespace meshes
