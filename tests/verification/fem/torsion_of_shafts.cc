// A round shaft of three diameters with sharp steps, twisted: P06 of the public cases. One end is clamped,
// the other has the traction of Saint-Venant's torsion, which a face's torque is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;

constexpr fem::Material steel{208e9, 0.3, 7850};  // a shear modulus of 80 GPa
constexpr double torque_Nm = 200;

/// Mean of the torsional shear on the surface at the row of nodes nearest to z.
double surface_shear_Pa(const verification::Solution& s, double z_m, double radius_m) {
  const auto on_surface = [&](Eigen::Index i) {
    return std::abs(std::hypot(s.place_m(0, i), s.place_m(1, i)) - radius_m) < 1e-6 * radius_m;
  };
  double nearest = 1;
  for (Eigen::Index i = 0; i < s.place_m.cols(); ++i)
    if (on_surface(i)) nearest = std::min(nearest, std::abs(s.place_m(2, i) - z_m));
  double sum = 0;
  int n = 0;
  for (Eigen::Index i = 0; i < s.place_m.cols(); ++i) {
    if (!on_surface(i) || std::abs(s.place_m(2, i) - z_m) > nearest + 1e-9) continue;
    sum += (s.stress_Pa(4, i) * s.place_m(0, i) - s.stress_Pa(5, i) * s.place_m(1, i)) / radius_m;
    ++n;
  }
  return sum / n;
}

TEST(P06, ShaftOfThreeDiameters) {
  meshes::Shaft shaft;
  shaft.segments = {{"thin", 0, 0.1, 0.03, 0, false},
                    {"middle", 0.1, 0.25, 0.04, 0, false},
                    {"thick", 0.25, 0.37, 0.05, 0, false}};
  shaft.fillets_m = {0, 0};
  meshes::ShaftMeshControl control;
  control.n_sectors = 8;
  control.cells_per_fillet_quarter = 4;
  auto built = fem_tests::build(shaft, control);
  built.body.material = steel;
  built.body.clamps = {{built.ports.at("end_1").boundary_id, {true, true, true}}};
  const auto s = verification::solve(
      built.body, {{fem::SurfaceResultant{built.ports.at("end_2"), Component::torque}, torque_Nm}});
  const double twist = s.displacement_m(1, s.at({0.025, 0, 0.37})) / 0.025;
  verification::check({"P06", "twist, elastic solution [rad]", 0.005200202606, twist}, s, 0.005);
  verification::check({"P06", "twist, strength of materials [rad]", 0.005124802922, twist}, s, 0.02);
  verification::check({"P06", "tau, d = 30 mm [Pa]", 37725616.14, surface_shear_Pa(s, 0.05, 0.015)}, s, 0.01);
  verification::check({"P06", "tau, d = 40 mm [Pa]", 15915494.31, surface_shear_Pa(s, 0.175, 0.02)}, s, 0.02);
  verification::check({"P06", "tau, d = 50 mm [Pa]", 8148733.086, surface_shear_Pa(s, 0.31, 0.025)}, s, 0.02);
}

}  // namespace
