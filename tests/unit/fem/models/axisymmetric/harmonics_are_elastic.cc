// Fourier harmonics of bodies of revolution against closed forms and the public cases of shoulder fillets.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fem/base/values/constants.h"
#include "fem/models/axisymmetric/axisymmetric_responses.h"
#include "tests/unit/fem/examples/meridian_tube.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using Phase = fem::SeatPressure::Phase;
using fem::pi;

using fem_tests::face, fem_tests::left, fem_tests::right, fem_tests::outside, fem_tests::tube;

fem::UnitLoad on_ends(int id, double z, Component c) {
  return {std::to_string(id) + "." + std::to_string(int(c)), fem::SurfaceResultant{face(id, z), c}};
}

/// Opposite loads on the two ends, as the sum of two channels.
fem_tests::LoadCase opposite(Component c) {
  return {{"1." + std::to_string(int(c)), -1}, {"2." + std::to_string(int(c)), 1}};
}

// Uniform pressure on the outside of a free tube: Lame. The field has 1 / r in it: cubic cells, fourth order.
TEST(Harmonics, ThickCylinderUnderPressure) {
  const double a = 0.02, b = 0.05, L = 0.06;
  const fem::LoadSurface seat{fem::LoadSurface::Kind::seat, outside, {0, 0, L / 2}, b, L};
  const auto r = fem::axisymmetric_responses(tube(a, b, L, 4, 8), {{"p", fem::SeatPressure{seat}}});
  const double p = 1 / (pi * b * L);
  for (std::size_t i = 0; i < r.nodes.n; ++i) {
    const double x = r.nodes.xyz_m[3 * i], y = r.nodes.xyz_m[3 * i + 1], radius = std::hypot(x, y);
    const double A = -p * b * b / (b * b - a * a), ratio = a * a / (radius * radius);
    const double radial = A * (1 - ratio), hoop = A * (1 + ratio), c = x / radius, s = y / radius;
    const double* sigma = &r.stress_Pa[6 * i];
    EXPECT_NEAR(sigma[0], radial * c * c + hoop * s * s, 2e-3 * p);
    EXPECT_NEAR(sigma[3], (radial - hoop) * c * s, 2e-3 * p);
    EXPECT_NEAR(sigma[2], 0, 2e-3 * p);
    const double E = fem_tests::steel.youngs_modulus_Pa, nu = fem_tests::steel.poisson_ratio;
    EXPECT_NEAR(r.displacement_m[3 * i] * c + r.displacement_m[3 * i + 1] * s,
                radius * (hoop - nu * radial) / E, 1e-4 * p * b / E);
  }
}

/// Bars with opposite loads on the two ends, spread as unit_load.h says: exact, the fields are polynomials.
struct BarUnder : testing::TestWithParam<double> {  // bore's radius
  const double b = 0.03, L = 0.1, a = GetParam();
  fem::UnitResponses solve(Component c) const {
    return fem::axisymmetric_responses(tube(a, b, L, 3, 2), {on_ends(left, 0, c), on_ends(right, L, c)});
  }
  const double area = pi * (b * b - a * a), inertia = pi / 4 * (std::pow(b, 4) - std::pow(a, 4));
  const double rounding = 1e-8;

  void expect(Component c, double scale,
              const std::function<std::array<double, 6>(double x, double y)>& wanted) const {
    const auto r = solve(c);
    EXPECT_LT(r.residual, 1e-9);
    for (std::size_t i = 0; i < r.nodes.n; ++i) {
      const auto got = fem_tests::stress(r, opposite(c), i);
      const auto right = wanted(r.nodes.xyz_m[3 * i], r.nodes.xyz_m[3 * i + 1]);
      for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(got[k], right[k], rounding * scale) << i << " " << k;
    }
  }
};
TEST_P(BarUnder, Tension) {
  expect(Component::fz, 1 / area, [&](double, double) -> std::array<double, 6> { return {0, 0, 1 / area}; });
}
TEST_P(BarUnder, Torsion) {
  expect(Component::torque, b / inertia, [&](double x, double y) -> std::array<double, 6> {
    return {0, 0, 0, 0, x / (2 * inertia), -y / (2 * inertia)};
  });
}
TEST_P(BarUnder, Bending) {
  expect(Component::mx, b / inertia, [&](double, double y) -> std::array<double, 6> {
    return {0, 0, y / inertia};
  });
  expect(Component::my, b / inertia, [&](double x, double) -> std::array<double, 6> {
    return {0, 0, -x / inertia};
  });
}
TEST_P(BarUnder, BendingBendsAsItShould) {
  const auto r = solve(Component::my);
  const double E = fem_tests::steel.youngs_modulus_Pa;
  // u_x = -M / 2 E I (z^2 + nu (x^2 - y^2)) up to rigid motion: compare two rings with the middle one.
  const auto sag = [&](double z) {
    double sum = 0, n = 0;
    for (std::size_t i = 0; i < r.nodes.n; ++i)
      if (std::abs(r.nodes.xyz_m[3 * i + 2] - z) < 1e-9 &&
          std::abs(std::hypot(r.nodes.xyz_m[3 * i], r.nodes.xyz_m[3 * i + 1]) - b) < 1e-9) {
        sum += r.displacement_m[(2 * i + 1) * 3] - r.displacement_m[2 * i * 3];
        n += 1;
      }
    return sum / n;
  };
  const double wanted = L * L / (8 * E * inertia);
  EXPECT_NEAR((sag(0) + sag(L)) / 2 - sag(L / 2), wanted, 1e-7 * wanted);
}
INSTANTIATE_TEST_SUITE_P(Harmonics, BarUnder, testing::Values(0.0, 0.012));

// A disc of nu = 0 under p cos n theta: radial and hoop stress on its rim are both -p cos n theta (Michell).
TEST(Harmonics, DiscUnderPressureThatChangesAround) {
  const double b = 0.03, L = 0.02;
  auto body = tube(0, b, L, 2, 8);
  body.material.poisson_ratio = 0;
  const fem::LoadSurface seat{fem::LoadSurface::Kind::seat, outside, {0, 0, L / 2}, b, L};
  for (const int n : {2, 3, 4})
    for (const auto phase : {Phase::cosine, Phase::sine}) {
      const auto r = fem::axisymmetric_responses(body, {{"p", fem::SeatPressure{seat, n, 0.5, phase}}});
      const double p = 0.5 / (pi * b * L);
      for (std::size_t i = 0; i < r.nodes.n; ++i) {
        const double x = r.nodes.xyz_m[3 * i], y = r.nodes.xyz_m[3 * i + 1];
        if (std::hypot(x, y) < b * (1 - 1e-9)) continue;
        const double angle = n * std::atan2(y, x);
        const double wanted = -p * (phase == Phase::sine ? std::sin(angle) : std::cos(angle));
        // n = 2 has cubic displacements, exact; n = 4 fifth powers of r on 8 cells: 7e-4
        const double tolerance = (n == 2 ? 1e-8 : 2e-3) * p;
        EXPECT_NEAR(r.stress_Pa[6 * i], wanted, tolerance) << n;
        EXPECT_NEAR(r.stress_Pa[6 * i + 1], wanted, tolerance) << n;
        EXPECT_NEAR(r.stress_Pa[6 * i + 3], 0, tolerance) << n;
      }
    }
}

/// The node at the place of another one, turned about the axis.
std::size_t turned_node(const fem::Nodes& nodes, std::size_t node, double angle) {
  const double *p = &nodes.xyz_m[3 * node], c = std::cos(angle), s = std::sin(angle);
  for (std::size_t i = 0; i < nodes.n; ++i) {
    const double* q = &nodes.xyz_m[3 * i];
    if (std::hypot(q[0] - c * p[0] + s * p[1], q[1] - s * p[0] - c * p[1], q[2] - p[2]) < 1e-9) return i;
  }
  throw std::out_of_range("no node there");
}

// A load along y is the load along x turned by a right angle, and so is its response: all of it, with the
// shear that the two harmonics of a turned pair have with opposite signs.
TEST(Harmonics, TurnWithTheirLoad) {
  const double b = 0.03, L = 0.1;
  const fem::LoadSurface seat{fem::LoadSurface::Kind::seat, outside, {0, 0, L / 2}, b, L, {1, 2}};
  auto body = tube(0, b, L, 4, 2);
  body.n_angles = 24;
  const auto r = fem::axisymmetric_responses(body, {{"fx", fem::SurfaceResultant{seat, Component::fx}},
                                                    {"fy", fem::SurfaceResultant{seat, Component::fy}},
                                                    {"c2", fem::SeatPressure{seat, 2}},
                                                    {"s2", fem::SeatPressure{seat, 2, 1, Phase::sine}}});
  double largest[2] = {0, 0}, across[2] = {0, 0};
  for (const double value : r.stress_Pa) largest[0] = std::max(largest[0], std::abs(value));
  for (const double value : r.displacement_m) largest[1] = std::max(largest[1], std::abs(value));
  for (std::size_t i = 0; i < r.nodes.n; ++i)
    for (int pair = 0; pair < 2; ++pair) {
      const int steps = pair == 0 ? 6 : 3;  // a quarter of the harmonic's period
      const std::size_t from = i * 4 + 2 * std::size_t(pair);
      const std::size_t to = turned_node(r.nodes, i, 2 * pi * steps / 24) * 4 + 2 * std::size_t(pair) + 1;
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(2 * pi * steps / 24, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      const auto tensor = [&](std::size_t at) {
        const double* s = &r.stress_Pa[6 * at];
        Eigen::Matrix3d m;
        m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
        return m;
      };
      const Eigen::Matrix3d wanted = turn * tensor(from) * turn.transpose();
      EXPECT_LT((tensor(to) - wanted).cwiseAbs().maxCoeff(), 1e-9 * largest[0]);
      const Eigen::Map<const Eigen::Vector3d> u(&r.displacement_m[3 * from]), v(&r.displacement_m[3 * to]);
      EXPECT_LT((v - turn * u).cwiseAbs().maxCoeff(), 1e-9 * largest[1]);
      const double angle = std::atan2(r.nodes.xyz_m[3 * i + 1], r.nodes.xyz_m[3 * i]);
      across[pair] = std::max(across[pair], std::abs(u[1] * std::cos(angle) - u[0] * std::sin(angle)));
    }
  for (const double motion : across) EXPECT_GT(motion, 1e-3 * largest[1]);  // so the sine's sign is seen
}

// Free fall strains nothing; spin of a thin ring is rho omega^2 r^2.
TEST(Harmonics, BodyForces) {
  using Field = fem::BodyForce::Field;
  const double a = 0.049, b = 0.051;
  const auto r =
      fem::axisymmetric_responses(tube(a, b, 0.002, 2, 2), {{"x", fem::BodyForce{Field::translation_x}},
                                                            {"z", fem::BodyForce{Field::translation_z}},
                                                            {"alpha", fem::BodyForce{Field::rotation}},
                                                            {"spin", fem::BodyForce{Field::spin}}});
  const double mass = 7850 * pi * (b * b - a * a) * 0.002;
  EXPECT_NEAR(r.resultants[0][0], mass, 1e-9 * mass);
  EXPECT_NEAR(r.resultants[1][2], mass, 1e-9 * mass);
  EXPECT_NEAR(r.resultants[2][5], mass * (a * a + b * b) / 2, 1e-9 * mass);
  for (std::size_t i = 0; i < r.nodes.n; i += 12) {  // at angle 0: yy is the hoop stress
    for (std::size_t c = 0; c < 18; ++c) EXPECT_NEAR(r.stress_Pa[i * 24 + c], 0, 1e-6);
    EXPECT_NEAR(r.stress_Pa[i * 24 + 18 + 1], 7850 * 0.05 * 0.05,
                0.06 * 7850 * 0.05 * 0.05);  // 2 (b - a) / r
  }
}

struct FilletCase {
  double D, r;  // over d
  double torsion, bending, tension;
};
// Public verification cases P08 and P09: an independent spectral element program, 5 to 6 digits.
constexpr FilletCase cases[] = {
    {1.1, 0.05, 1.432942, 1.89369, 2.01310}, {1.2, 0.05, 1.527733, 2.08932, 2.31102},
    {1.2, 0.10, 1.333653, 1.70551, 1.88236}, {1.5, 0.05, 1.615949, 2.27198, 2.69193},
    {1.5, 0.10, 1.379884, 1.80024, 2.11426}, {1.5, 0.20, 1.223835, 1.47689, 1.70313},
    {2.0, 0.05, 1.641986, 2.32778, 2.89307}, {2.0, 0.10, 1.393175, 1.82423, 2.22890}};

class FilletOfHarmonics : public testing::TestWithParam<FilletCase> {};

TEST_P(FilletOfHarmonics, HasTheStressConcentrationOfTheElasticSolution) {
  const auto c = GetParam();
  const double d = 0.03, D = c.D * d;
  meshes::Shaft shaft;
  shaft.segments = {{"thin", -1.5 * d, 0, d, 0, false}, {"thick", 0, 1.5 * D, D, 0, false}};
  shaft.fillets_m = {c.r * d};
  auto body = fem_tests::half_section(shaft, {});
  body.n_angles = 4;
  const auto ports = fem_tests::build(shaft, {}).ports;
  std::vector<fem::UnitLoad> loads;
  for (const auto* end : {"end_1", "end_2"})
    for (const auto component : {Component::torque, Component::mx, Component::fz})
      loads.push_back({std::string(end) + std::to_string(int(component)),
                       fem::SurfaceResultant{ports.at(end), component}});
  const auto r = fem::axisymmetric_responses(body, loads);
  FilletCase peak{c.D, c.r, 0, 0, 0};
  for (std::size_t f = 0; f < r.nodes.n_faces(); ++f) {
    if (r.nodes.face_boundary_id[f] != body.tori.at(0).boundary_id) continue;
    for (const auto node : r.nodes.face(f)) {
      const auto principal = [&](Component component) -> Eigen::Vector3d {
        const auto name = std::to_string(int(component));
        const auto s = fem_tests::stress(r, {{"end_2" + name, 1}, {"end_1" + name, -1}}, std::size_t(node));
        Eigen::Matrix3d m;
        m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
        return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues();
      };
      const auto twist = principal(Component::torque);
      peak.torsion = std::max(peak.torsion, (twist[2] - twist[0]) / 2 * pi * d * d * d / 16);
      peak.bending = std::max(peak.bending, principal(Component::mx)[2] * pi * d * d * d / 32);
      peak.tension = std::max(peak.tension, principal(Component::fz)[2] * pi * d * d / 4);
    }
  }
  std::printf("D/d %.1f r/d %.2f  torsion %+.3f %%  bending %+.3f %%  tension %+.3f %%, %zu unknowns\n", c.D,
              c.r, 100 * (peak.torsion / c.torsion - 1), 100 * (peak.bending / c.bending - 1),
              100 * (peak.tension / c.tension - 1), r.n_dofs);
  EXPECT_NEAR(peak.torsion, c.torsion, 0.01 * c.torsion);
  EXPECT_NEAR(peak.bending, c.bending, 0.01 * c.bending);
  EXPECT_NEAR(peak.tension, c.tension, 0.01 * c.tension);
}
INSTANTIATE_TEST_SUITE_P(P08_P09, FilletOfHarmonics, testing::ValuesIn(cases));

TEST(Harmonics, RefuseWhatIsNotAxisymmetric) {
  const auto body = tube(0, 0.03, 0.1, 2, 2);
  const auto message = [&](const fem::UnitLoad& load) -> std::string {
    try {
      fem::axisymmetric_responses(body, {load});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(
      message({"keyway.torque", fem::SurfaceResultant{face(77, 0), Component::torque}}).find("keyway.torque"),
      std::string::npos);
  EXPECT_NE(message({"half.ax", fem::BodyForce{fem::BodyForce::Field::spin, {5}}}).find("half.ax"),
            std::string::npos);
  const fem::LoadSurface seat{fem::LoadSurface::Kind::seat, outside, {0, 0, 0.05}, 0.03, 0.1};
  EXPECT_NE(message({"seat.p1", fem::SeatPressure{seat, 1}}).find("harmonic 1"), std::string::npos);
  EXPECT_THROW(fem::axisymmetric_responses(body, {}), std::invalid_argument);
}

}  // namespace
