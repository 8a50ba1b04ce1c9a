#include "fem/solve/modes/attached_masses.h"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fem/base/common/dense_algebra.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/mesh/grid/hanging_nodes.h"

namespace fem {
namespace {

void refuse_impossible(const AttachedMass& mass) {
  for (const double value :
       {mass.mass_kg, mass.inertia_kg_m2[0], mass.inertia_kg_m2[1], mass.inertia_kg_m2[2]})
    if (!(value >= 0) || !std::isfinite(value))
      throw std::invalid_argument("attached mass: " + std::to_string(value) +
                                  " must be zero or positive, as a mass and as an inertia");
}

/// About the centre of the surface: kinetic energy = 1/2 (v, w)' A (v, w).
Eigen::Matrix<double, 6, 6> rigid_mass(const AttachedMass& mass) {
  const Eigen::Vector3d d(mass.offset_m[0], mass.offset_m[1], mass.offset_m[2]);
  Eigen::Matrix3d cross;  // d x
  cross << 0, -d[2], d[1], d[2], 0, -d[0], -d[1], d[0], 0;
  Eigen::Matrix<double, 6, 6> result = Eigen::Matrix<double, 6, 6>::Zero();
  result.topLeftCorner<3, 3>().diagonal().setConstant(mass.mass_kg);
  result.topRightCorner<3, 3>() = -mass.mass_kg * cross;
  result.bottomLeftCorner<3, 3>() = mass.mass_kg * cross;
  result.bottomRightCorner<3, 3>() = -mass.mass_kg * cross * cross;
  for (int i = 0; i < 3; ++i) result(3 + i, 3 + i) += mass.inertia_kg_m2[std::size_t(i)];
  return result;
}

}  // namespace

AttachedMasses::AttachedMasses(const Grid& grid, const std::vector<AttachedMass>& masses) {
  const auto n = Eigen::Index(masses.size());
  resultants_.resize(3 * Eigen::Index(grid.n_nodes), 6 * n);
  mass_ = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& mass = masses[std::size_t(i)];
    refuse_impossible(mass);
    resultants_.middleCols<6>(6 * i) = unit_resultants(grid, mass.surface);
    mass_.block<6, 6>(6 * i, 6 * i) = rigid_mass(mass);
  }
  move_to_masters(grid.hanging, resultants_);
}

void AttachedMasses::add_to(const Eigen::MatrixXd& motion, Eigen::MatrixXd& force) const {
  if (mass_.size() == 0) return;
  force += product(resultants_, mass_ * transposed_product(resultants_, motion));
}

}  // namespace fem
