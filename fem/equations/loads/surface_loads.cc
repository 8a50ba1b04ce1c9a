#include "fem/equations/loads/surface_loads.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fem/base/common/dense_algebra.h"
#include "fem/base/values/constants.h"
#include "fem/base/values/errors.h"
#include "fem/equations/loads/axial_profile.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {

namespace {

void refuse_impossible(const LoadSurface& surface) {
  const bool seat = surface.kind == LoadSurface::Kind::seat;
  if (seat && !(surface.radius_m > 0 && surface.length_m > 0))
    throw std::invalid_argument("loaded surface with boundary group " + std::to_string(surface.boundary_id) +
                                ": radius and length must be positive");
}

std::vector<BoundaryFace> faces_of(const Grid& grid, int boundary_id) {
  std::vector<BoundaryFace> faces;
  for (const auto& face : grid.boundary)
    if (face.boundary_id == boundary_id) faces.push_back(face);
  return faces;
}

/// Calls take(node, force) for the share of every node of every face, one Gauss point after another.
/// @param traction  as LoadedSurface's
template <typename Traction, typename Take>
void for_each_force(const Grid& grid, const std::vector<BoundaryFace>& faces, const LoadSurface& surface,
                    const Traction& traction, const Take& take) {
  const Tabulation at = gauss_on_face(grid.shape(), grid.degree + 3);
  const Eigen::Map<const Eigen::Vector3d> centre(surface.centre_m.data());
  for (const auto& face : faces) {
    const auto face_nodes = nodes_of_face(grid, face.cell, face.face);
    for (int q = 0; q < at.n_points; ++q) {
      const FacePoint p = face_point(grid, face_nodes, at, q);
      const double area = p.area.norm();
      const Eigen::Vector3d t = area * traction(p.position - centre, p.area / area);
      for (int i = 0; i < at.n_shapes; ++i)
        take(face_nodes[std::size_t(i)], at.value[std::size_t(q) * at.n_shapes + i] * t);
    }
  }
}

}  // namespace

LoadedSurface::LoadedSurface(const Grid& grid, const LoadSurface& surface) : grid_(&grid), surface_(surface) {
  refuse_impossible(surface);
  faces_ = faces_of(grid, surface.boundary_id);
  if (faces_.empty())
    throw std::invalid_argument("the mesh has no faces in the boundary group " +
                                std::to_string(surface.boundary_id) +
                                " of a loaded surface: check the port's group in the mesh");
  for (const auto& face : faces_)
    for (const auto node : nodes_of_face(grid, face.cell, face.face)) nodes_.push_back(node);
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());

  // Six tractions whose resultants are about right, in the order of Component; the mesh's own resultants then
  // make them exact. local = position from the centre.
  using V = Eigen::Vector3d;
  if (surface.kind == LoadSurface::Kind::seat) {
    const auto taper = [half = surface.length_m / 2](double z) {
      return std::max(0.0, 1 - z * z / (half * half));
    };
    const auto ring = [](const V& p) { return std::hypot(p[0], p[1]); };
    const AxialProfile profile(surface);
    raw_ = {[=](const V& p, const V& n) -> V { return profile(p[2]) * p[0] / ring(p) * n; },
            [=](const V& p, const V& n) -> V { return profile(p[2]) * p[1] / ring(p) * n; },
            [=](const V& p, const V&) -> V { return taper(p[2]) * V::UnitZ(); },
            [=](const V& p, const V& n) -> V { return p[2] * p[1] / ring(p) * n; },
            [=](const V& p, const V& n) -> V { return p[2] * p[0] / ring(p) * n; },
            [=](const V& p, const V&) -> V { return taper(p[2]) / ring(p) * V(-p[1], p[0], 0); }};
  } else {
    raw_ = {[](const V&, const V&) -> V { return V::UnitX(); },
            [](const V&, const V&) -> V { return V::UnitY(); },
            [](const V&, const V&) -> V { return V::UnitZ(); },
            [](const V& p, const V&) -> V { return V::UnitX().cross(p); },
            [](const V& p, const V&) -> V { return V::UnitY().cross(p); },
            [](const V& p, const V&) -> V { return V::UnitZ().cross(p); }};
  }
  basis_.resize(3 * nodes_.size(), 6);
  for (int k = 0; k < 6; ++k) basis_.col(k) = integrate(raw_[k]);
  shares_ = basis_.colwise().norm().cwiseInverse().asDiagonal();
  basis_.colwise().normalize();
  if (!is_invertible(about_centre(basis_)))
    throw MeshUnusable("the faces of boundary group " + std::to_string(surface.boundary_id) +
                       " cannot carry six independent resultants: a seat must go all the way round its axis");
  // Twice: the second pass takes out what rounding left in the first.
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::MatrixXd exact = inverse(about_centre(basis_));
    basis_ = product(basis_, exact);
    shares_ = product(shares_, exact);
  }
}

Eigen::VectorXd LoadedSurface::integrate(const Traction& traction) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * nodes_.size());
  for_each_force(*grid_, faces_, surface_, traction, [&](std::int32_t node, const Eigen::Vector3d& f) {
    force.segment<3>(3 * (std::lower_bound(nodes_.begin(), nodes_.end(), node) - nodes_.begin())) += f;
  });
  return force;
}

Eigen::VectorXd LoadedSurface::integrate_on(const Grid& part, const Traction& traction) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * Eigen::Index(part.n_nodes));
  for_each_force(part, faces_of(part, surface_.boundary_id), surface_, traction,
                 [&](std::int32_t node, const Eigen::Vector3d& f) { force.segment<3>(3 * node) += f; });
  return force;
}

Eigen::MatrixXd LoadedSurface::about_centre(const Eigen::MatrixXd& force) const {
  const Eigen::Map<const Eigen::Vector3d> centre(surface_.centre_m.data());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(6, force.cols());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(grid_->position(nodes_[i])) - centre;
    for (Eigen::Index k = 0; k < force.cols(); ++k) {
      const Eigen::Vector3d f = force.block<3, 1>(3 * i, k);
      sums.col(k).head<3>() += f;
      sums.col(k).tail<3>() += x.cross(f);
    }
  }
  return sums;
}

Eigen::VectorXd LoadedSurface::resultant(SurfaceResultant::Component component) const {
  return basis_.col(static_cast<int>(component));
}

Eigen::VectorXd LoadedSurface::resultant_on(const Grid& part, SurfaceResultant::Component component) const {
  return integrate_on(part, sum_of_raw(shares_.col(static_cast<int>(component))));
}

LoadedSurface::Traction LoadedSurface::sum_of_raw(const Eigen::VectorXd& shares) const {
  return [this, shares](const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < raw_.size(); ++k) sum += shares[Eigen::Index(k)] * raw_[k](p, normal);
    return sum;
  };
}

LoadedSurface::Traction LoadedSurface::pressure_of(const SeatPressure& load) const {
  if (surface_.kind != LoadSurface::Kind::seat)
    throw std::invalid_argument("pressure harmonics need a seat; a face has none");
  const int n = load.harmonic;
  if (n < 0 || n == 1)
    throw std::invalid_argument("pressure harmonic " + std::to_string(n) +
                                ": must be 0, 2, 3 ... (harmonic 1 is the resultant fx, fy)");
  const bool sine = load.phase == SeatPressure::Phase::sine;
  if (sine && n == 0) throw std::invalid_argument("pressure harmonic 0 has no sine phase");
  const AxialProfile profile(surface_);
  const double scale = load.coefficient / (pi * surface_.radius_m * surface_.length_m);
  return [=](const Eigen::Vector3d& p, const Eigen::Vector3d& normal) -> Eigen::Vector3d {
    const double theta = std::atan2(p[1], p[0]);
    return -scale * profile(p[2]) * (sine ? std::sin(n * theta) : std::cos(n * theta)) * normal;
  };
}

Eigen::VectorXd LoadedSurface::pressure_on(const Grid& part, const SeatPressure& load) const {
  const Traction traction = pressure_of(load);
  Eigen::VectorXd force = integrate_on(part, traction);
  if (!load.keeps_resultants)
    force -= integrate_on(part, sum_of_raw(product(shares_, about_centre(integrate(traction)))));
  return force;
}

Eigen::VectorXd LoadedSurface::pressure(const SeatPressure& load) const {
  Eigen::VectorXd force = integrate(pressure_of(load));
  if (load.keeps_resultants) return force;
  for (int pass = 0; pass < 2; ++pass) subtract_product(basis_, about_centre(force), force);
  return force;
}

Eigen::VectorXd LoadedSurface::on_body(const Eigen::VectorXd& force) const {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(3 * grid_->n_nodes);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    column.segment<3>(3 * std::size_t(nodes_[i])) = force.segment<3>(3 * i);
  return column;
}

bool same_surface(const LoadSurface& a, const LoadSurface& b) {
  return a.kind == b.kind && a.boundary_id == b.boundary_id && a.centre_m == b.centre_m &&
         a.radius_m == b.radius_m && a.length_m == b.length_m && a.axial_profile == b.axial_profile;
}

}  // namespace fem
