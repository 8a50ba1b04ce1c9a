/// Thick cylinders whose ends stay where they are, under pressure or spinning: a quarter of one, on even and
/// distorted meshes, and its closed form.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/field_errors.h"

namespace verification {

struct PlaneStrainCylinder {
  static constexpr double inner_m = 0.1, outer_m = 0.2, height_m = 0.05;
  static constexpr double pressure_Pa = 50e6, speed_rad_s = 1000;

  bool spins = false;  ///< else it is under pressure from inside
  fem::CellKind kind = fem::CellKind::hexahedra;
  int degree = 2;
  double distortion = 0;  ///< 0.1: cells differ in size by a factor of two
  double poisson_ratio = 0.3;

  fem::Material material() const { return {210e9, poisson_ratio, 7850}; }

  /// @param n  cells along the radius and around; an eighth of it along the axis
  fem::Body body(int n) const {
    Block block;
    block.cells = {n, n, std::max(1, n / 8)};
    block.map = [c = *this](const Point& at) {
      const Point d(at[0] + c.distortion * at[0] * (1 - at[0]) * std::sin(6 * at[1]),
                    at[1] + c.distortion * at[1] * (1 - at[1]) * std::sin(6 * at[0]), at[2]);
      const double r = inner_m * std::pow(outer_m / inner_m, d[0]), angle = pi / 2 * d[1];
      return Point(r * std::cos(angle), r * std::sin(angle), height_m * d[2]);
    };
    fem::Body body;
    if (kind == fem::CellKind::tetrahedra) {
      body.mesh = tetrahedra_of(block);
    } else {
      body.mesh = hexahedra_of(block);
      fem::CylinderChart chart;
      chart.volume_id = block_volume;
      body.cylinders = {chart};
    }
    body.material = material();
    body.degree = degree;
    body.clamps = {{begin_2, {false, true, false}},
                   {end_2, {true, false, false}},
                   {begin_3, {false, false, true}},
                   {end_3, {false, false, true}}};
    return body;
  }

  LoadCase loads() const {
    if (spins) return {{fem::BodyForce{fem::BodyForce::Field::spin}, speed_rad_s * speed_rad_s}};
    return {{uniform_pressure(begin_1, {0, 0, height_m / 2}, height_m), pressure_Pa}};
  }

  /// Source: Timoshenko and Goodier, Theory of Elasticity, art. 28 and 32, with the constants of plane
  /// strain.
  Field exact() const {
    const double a = inner_m, b = outer_m, nu = poisson_ratio / (1 - poisson_ratio);
    const double e = material().youngs_modulus_Pa / (1 - poisson_ratio * poisson_ratio);
    const double w = spins ? material().density_kg_m3 * speed_rad_s * speed_rad_s / 8 : 0;
    const double s = spins ? 0 : pressure_Pa * a * a / (b * b - a * a);
    const auto stress = [=, nu_3 = poisson_ratio](double r) {
      const double radial =
          w * (3 + nu) * (a * a + b * b - a * a * b * b / (r * r) - r * r) + s * (1 - b * b / (r * r));
      const double around =
          w * ((3 + nu) * (a * a + b * b + a * a * b * b / (r * r)) - (1 + 3 * nu) * r * r) +
          s * (1 + b * b / (r * r));
      return std::array<double, 3>{radial, around, nu_3 * (radial + around)};
    };
    return axisymmetric(
        [=](double r) {
          const auto at = stress(r);
          return r / e * (at[1] - nu * at[0]);
        },
        stress);
  }
};

}  // namespace verification
