#include "fem/mesh/grid/geometry_distance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/charts.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {

namespace {

/// Distance from the axis, or from the circle of centres, of a point; and the radius that it should be.
struct Surface {
  std::function<double(const double*)> distance_m;
  double radius_m = 0;
  bool is_fillet = false;
};

Coordinates coordinates(const double* x) {
  return {x[0], x[1], x[2]};
}

/// The surface that all nodes of a face lie on; none if they do not.
std::optional<Surface> surface_of(const Grid& grid, const Body& body, const std::vector<LoadSurface>& seats,
                                  const BoundaryFace& face, const std::vector<std::int32_t>& nodes) {
  for (const auto& torus : body.tori)
    if (torus.boundary_id == face.boundary_id)
      return Surface{[&torus](const double* x) { return pull_back(torus, coordinates(x))[0]; },
                     torus.radius_m, true};
  for (const auto& seat : seats)
    if (seat.kind == LoadSurface::Kind::seat && seat.boundary_id == face.boundary_id)
      return Surface{
          [&seat](const double* x) { return std::hypot(x[0] - seat.centre_m[0], x[1] - seat.centre_m[1]); },
          seat.radius_m, false};
  for (const auto& chart : body.cylinders) {
    if (chart.volume_id != grid.volume_id[face.cell]) continue;
    const auto radius = [&chart](const double* x) { return pull_back(chart, coordinates(x))[0]; };
    double low = radius(grid.position(nodes[0])), high = low;
    for (const auto node : nodes) {
      low = std::min(low, radius(grid.position(node)));
      high = std::max(high, radius(grid.position(node)));
    }
    if (high - low <= 1e-9 * high) return Surface{radius, (low + high) / 2, false};
  }
  return std::nullopt;
}

}  // namespace

GeometryError geometry_error(const Grid& grid, const Body& body, const std::vector<LoadSurface>& seats) {
  const Tabulation at = gauss_on_face(grid.shape(), grid.degree + 2);
  GeometryError worst;
  for (const auto& face : grid.boundary) {
    const auto nodes = nodes_of_face(grid, face.cell, face.face);
    const auto surface = surface_of(grid, body, seats, face, nodes);
    if (!surface) continue;
    ++worst.n_faces;
    auto& here = worst.surfaces[face.boundary_id];
    for (int q = 0; q < at.n_points; ++q) {
      const Eigen::Vector3d x = face_point(grid, nodes, at, q).position;
      const double error = std::abs(surface->distance_m(x.data()) - surface->radius_m);
      // Fillets go around the z axis.
      const double from_axis_m = surface->is_fillet ? std::hypot(x[0], x[1]) : surface->radius_m;
      here.of_axis = std::max(here.of_axis, error / from_axis_m);
      if (surface->is_fillet) here.of_fillet = std::max(here.of_fillet, error / surface->radius_m);
      if (error / surface->radius_m <= worst.relative) continue;
      worst.relative = error / surface->radius_m;
      worst.error_m = error;
      worst.place_m = {x[0], x[1], x[2]};
    }
  }
  return worst;
}

}  // namespace fem
