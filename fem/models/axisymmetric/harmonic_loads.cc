#include "fem/models/axisymmetric/harmonic_loads.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "fem/base/common/dense_algebra.h"
#include "fem/base/values/constants.h"
#include "fem/equations/loads/axial_profile.h"
#include "fem/models/axisymmetric/harmonic_strain.h"

namespace fem {
namespace {

using Eigen::Vector3d;

}  // namespace

void add_to(HarmonicForces& forces, int m, bool turned, const Eigen::VectorXd& force) {
  for (auto& known : forces)
    if (known.m == m && known.turned == turned) {
      known.force += force;
      return;
    }
  forces.push_back({m, turned, force});
}

HarmonicLoads::HarmonicLoads(const MeridianGrid& grid, const MeridianBody& body)
    : grid_(&grid), body_(&body) {
  const auto all = points_between(-1e300, 1e300);
  const double density = body.material.density_kg_m3;
  for (int m = 0; m < 2; ++m) {
    modes_[std::size_t(m)] = modes(m, 0);
    auto& mass = mass_modes_[std::size_t(m)];
    mass.resize(3 * grid.n_nodes(), 2);
    for (int k = 0; k < 2; ++k)
      mass.col(k) = density * integrate(all, m, rigid_tractions(0)[std::size_t(2 * m + k)]);
  }
}

std::array<HarmonicLoads::Traction, 4> HarmonicLoads::rigid_tractions(double centre_z_m) {
  return {[](const auto&) { return Vector3d(0, 0, 1); }, [](const auto& p) { return Vector3d(0, p.r_m, 0); },
          [](const auto&) { return Vector3d(1, -1, 0); },
          [=](const auto& p) { return Vector3d(p.z_m - centre_z_m, centre_z_m - p.z_m, -p.r_m); }};
}

Eigen::MatrixXd HarmonicLoads::modes(int m, double centre_z_m) const {
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(3 * grid_->n_nodes(), 2);
  for (int i = 0; i < grid_->n_nodes(); ++i) {
    const double z = grid_->z_m[std::size_t(i)] - centre_z_m, r = grid_->r_m[std::size_t(i)];
    if (m == 0) {
      modes(3 * i + 2, 0) = 1;
      modes(3 * i + 1, 1) = r;
    } else {
      modes.block<3, 1>(3 * i, 0) << 1, -1, 0;
      modes.block<3, 1>(3 * i, 1) << z, -z, -r;
    }
  }
  return modes;
}

std::vector<const SectionPoint*> HarmonicLoads::points_of(const LoadSurface& surface) const {
  std::vector<const SectionPoint*> points;
  for (const auto& edge : grid_->edges)
    if (edge.boundary_id == surface.boundary_id)
      for (const auto& p : edge.points) points.push_back(&p);
  if (points.empty())
    throw std::invalid_argument("the section has no edges in the boundary group " +
                                std::to_string(surface.boundary_id) +
                                " of a loaded surface: what is not axisymmetric needs the solid model");
  return points;
}

std::vector<const SectionPoint*> HarmonicLoads::points_between(double begin_m, double end_m) const {
  std::vector<const SectionPoint*> points;
  for (const auto& cell : grid_->cell_points)
    for (const auto& p : cell)
      if (p.z_m >= begin_m && p.z_m <= end_m) points.push_back(&p);
  return points;
}

Eigen::VectorXd HarmonicLoads::integrate(const std::vector<const SectionPoint*>& points, int m,
                                         const Traction& traction) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * grid_->n_nodes());
  for (const auto* p : points) {
    const Vector3d t = angle_integral(m) * p->r_m * p->weight * traction(*p);
    const auto& nodes = grid_->cell_nodes[std::size_t(p->cell)];
    for (std::size_t i = 0; i < nodes.size(); ++i)
      force.segment<3>(3 * nodes[i]) += p->value[Eigen::Index(i)] * t;
  }
  return force;
}

HarmonicLoads::Basis HarmonicLoads::basis(const std::vector<const SectionPoint*>& points, double centre_z_m,
                                          const std::array<Traction, 4>& raw) const {
  const Eigen::MatrixXd rigid_0 = modes(0, centre_z_m), rigid_1 = modes(1, centre_z_m);
  Eigen::MatrixXd own_0(3 * grid_->n_nodes(), 2), own_1(3 * grid_->n_nodes(), 2);
  for (int k = 0; k < 2; ++k) {
    own_0.col(k) = integrate(points, 0, raw[std::size_t(k)]);
    own_1.col(k) = integrate(points, 1, raw[2 + std::size_t(k)]);
  }
  own_0 = product(own_0, inverse(transposed_product(rigid_0, own_0)));
  own_1 = product(own_1, inverse(transposed_product(rigid_1, own_1)));
  return {own_0.col(0), own_0.col(1), own_1.col(0), own_1.col(1)};
}

HarmonicLoads::Basis HarmonicLoads::basis_of(const LoadSurface& surface) const {
  const auto points = points_of(surface);
  const double centre = surface.centre_m[2];
  if (surface.kind == LoadSurface::Kind::face) return basis(points, centre, rigid_tractions(centre));
  const double half = surface.length_m / 2;
  const auto taper = [=](const SectionPoint& p) {
    const double zeta = (p.z_m - centre) / half;
    return std::max(0.0, 1 - zeta * zeta);
  };
  const AxialProfile profile(surface);
  return basis(
      points, centre,
      {[=](const auto& p) { return Vector3d(0, 0, taper(p)); },
       [=](const auto& p) { return Vector3d(0, taper(p), 0); },
       [=](const auto& p) -> Vector3d {
         return profile(p.z_m - centre) * Vector3d(p.normal_r, 0, p.normal_z);
       },
       [=](const auto& p) -> Vector3d { return (p.z_m - centre) * Vector3d(p.normal_r, 0, p.normal_z); }});
}

HarmonicForces HarmonicLoads::forces_of(const SurfaceResultant& load) const {
  using Component = SurfaceResultant::Component;
  const Basis own = basis_of(load.surface);
  const double x = load.surface.centre_m[0], y = load.surface.centre_m[1];
  HarmonicForces forces;
  switch (load.component) {
    case Component::fx:
      add_to(forces, 1, false, own.force);
      if (y != 0) add_to(forces, 0, false, -y * own.torque);
      break;
    case Component::fy:
      add_to(forces, 1, true, own.force);
      if (x != 0) add_to(forces, 0, false, x * own.torque);
      break;
    case Component::fz:
      add_to(forces, 0, false, own.axial);
      if (x != 0) add_to(forces, 1, false, -x * own.couple);
      if (y != 0) add_to(forces, 1, true, -y * own.couple);  // the turned one's couple is about -x
      break;
    case Component::mx:
      add_to(forces, 1, true, -own.couple);
      break;
    case Component::my:
      add_to(forces, 1, false, own.couple);
      break;
    case Component::torque:
      add_to(forces, 0, false, own.torque);
      break;
  }
  return forces;
}

HarmonicForces HarmonicLoads::forces_of(const SeatPressure& load) const {
  if (load.surface.kind != LoadSurface::Kind::seat)
    throw std::invalid_argument("pressure harmonics need a seat; a face has none");
  const int n = load.harmonic;
  const bool sine = load.phase == SeatPressure::Phase::sine;
  if (n < 0 || n == 1 || (sine && n == 0))
    throw std::invalid_argument("pressure harmonic " + std::to_string(n) +
                                ": must be 0, 2, 3 ..., and 0 has no sine phase");
  const AxialProfile profile(load.surface);
  const double scale = -load.coefficient / (pi * load.surface.radius_m * load.surface.length_m);
  const double centre = load.surface.centre_m[2];
  return {{n, sine, integrate(points_of(load.surface), n, [&](const auto& p) -> Vector3d {
             return scale * profile(p.z_m - centre) * Vector3d(p.normal_r, 0, p.normal_z);
           })}};
}

HarmonicForces HarmonicLoads::operator()(const UnitLoad& load) const {
  try {
    return std::visit([&](const auto& shape) { return forces_of(shape); }, load.shape);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("channel " + load.channel + ": " + error.what());
  }
}

std::array<double, 6> HarmonicLoads::resultant(const HarmonicForces& forces) const {
  std::array<double, 6> sum{};
  for (const auto& part : forces) {
    if (part.m > 1) continue;
    const Eigen::Vector2d r = transposed_product(modes_[std::size_t(part.m)], part.force);
    if (part.m == 0) {
      sum[2] += r[0];
      sum[5] += r[1];
    } else if (part.turned) {
      sum[1] += r[0];
      sum[3] -= r[1];
    } else {
      sum[0] += r[0];
      sum[4] += r[1];
    }
  }
  return sum;
}

void HarmonicLoads::balance(int m, Eigen::VectorXd& force) const {
  if (m > 1) return;
  const auto &rigid = modes_[std::size_t(m)], &mass = mass_modes_[std::size_t(m)];
  subtract_product(mass, solve(transposed_product(rigid, mass), transposed_product(rigid, force)), force);
}

void HarmonicLoads::remove_motion(int m, Eigen::MatrixXd& displacement) const {
  if (m > 1) return;
  const auto &rigid = modes_[std::size_t(m)], &mass = mass_modes_[std::size_t(m)];
  subtract_product(rigid, solve(transposed_product(rigid, mass), transposed_product(mass, displacement)),
                   displacement);
}

}  // namespace fem
