/// Errors against an exact field over the whole body, and the orders in which they fall.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <string>

#include "fem/stress/cells/cell_stress.h"
#include "tests/verification/fem/bodies/figures.h"

namespace verification {

/// Displacement and stress (xx, yy, zz, xy, yz, xz) at a place.
struct Field {
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> displacement_m;
  std::function<Eigen::Matrix<double, 6, 1>(const Eigen::Vector3d&)> stress_Pa;
};

/// Plane fields round the z axis: u_r(r), and sigma_r, sigma_theta, sigma_z.
Field axisymmetric(const std::function<double(double)>& radial_m,
                   const std::function<std::array<double, 3>(double)>& stress_Pa);

/// L2 norms of the errors, relative to those of the exact field. The stress is that of the cells, as the
/// displacement gives it: its norm is that of the energy up to the material's constants.
struct FieldErrors {
  double displacement = 0, stress = 0;
};
FieldErrors field_errors(const fem::Grid& grid, const fem::Material& material, const Field& exact,
                         const fem::ConstBlock& displacement_m);

/// Solves on two meshes, the second with cells of half the size in the plane, and expects the order degree +
/// 1 for displacement, degree for stress.
void expect_orders(const std::string& name, const Field& exact, const fem::Body& coarse,
                   const fem::Body& fine, const LoadCase& loads);

/// The same for errors at hand.
void expect_orders(const std::string& name, int degree, const FieldErrors& coarse, const FieldErrors& fine,
                   const Solution& finest);

}  // namespace verification
