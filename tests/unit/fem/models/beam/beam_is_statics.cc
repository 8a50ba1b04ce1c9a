// The beam model against closed forms: what statics and Timoshenko's beam say by hand.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "fem/base/values/constants.h"
#include "fem/models/beam/beam_responses.h"
#include "fem/models/beam/fillet_factors.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using fem::pi;
const fem::Material steel = fem_tests::steel;

fem::LoadSurface seat(double z, double length, double radius, double x = 0, double y = 0) {
  return {fem::LoadSurface::Kind::seat, 1, {x, y, z}, radius, length};
}
fem::LoadSurface face(double z, double x = 0, double y = 0) {
  return {fem::LoadSurface::Kind::face, 1, {x, y, z}};
}

/// Of diameter d from 0 to L, its surface in two pieces that meet in the middle.
fem::BeamShaft plain_bar(double d, double L) {
  fem::BeamShaft shaft;
  shaft.segments = {{0, L, d / 2}};
  shaft.pieces = {{0, 0, L / 2, 7}, {0, L / 2, L, 8}};
  shaft.material = steel;
  return shaft;
}

std::size_t node_at(const fem::UnitResponses& r, double x, double y, double z) {
  for (std::size_t i = 0; i < r.nodes.n; ++i)
    if (std::hypot(r.nodes.xyz_m[3 * i] - x, r.nodes.xyz_m[3 * i + 1] - y, r.nodes.xyz_m[3 * i + 2] - z) <
        1e-9)
      return i;
  throw std::out_of_range("no node there");
}

/// Sum of factor times displacement.
Eigen::Vector3d displacement(const fem::UnitResponses& r, const std::vector<double>& factors, std::size_t i) {
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < factors.size(); ++k)
    u += factors[k] * Eigen::Map<const Eigen::Vector3d>(&r.displacement_m[(i * factors.size() + k) * 3]);
  return u;
}

TEST(Beam, ThreePointLoading) {
  const double d = 0.04, L = 0.6, b = 0.01, R = d / 2;
  const auto r = fem::beam_responses(
      plain_bar(d, L), {{"left", fem::SurfaceResultant{seat(b / 2, b, R), Component::fx}},
                        {"middle", fem::SurfaceResultant{seat(L / 2, b, R), Component::fx}},
                        {"right", fem::SurfaceResultant{seat(L - b / 2, b, R), Component::fx}}});
  const double span = L - b, area = pi * R * R, inertia = pi * std::pow(R, 4) / 4;
  const fem_tests::LoadCase sum{{"left", -0.5}, {"middle", 1}, {"right", -0.5}};
  const auto middle = fem_tests::stress(r, sum, node_at(r, R, 0, L / 2));
  const double moment = span / 4 - b / 8;  // spread over b
  // Force along +x in the middle: tension on that side. Exact but for rounding.
  EXPECT_NEAR(middle[2], moment * R / inertia, 1e-9 * moment * R / inertia);
  for (const int c : {0, 1, 3, 4, 5}) EXPECT_NEAR(middle[c], 0, 1e-9 * std::abs(middle[2]));
  // A quarter along, the shear force is 1/2: at the rim across the load 4/3 V / A.
  const auto quarter = fem_tests::stress(r, sum, node_at(r, 0, R, L / 4));
  EXPECT_NEAR(std::abs(quarter[5]), 4.0 / 3 * 0.5 / area, 1e-9 / area);
  EXPECT_NEAR(quarter[2], 0, 1e-9 * std::abs(middle[2]));

  const std::vector<double> factors{-0.5, 1, -0.5};
  const double E = steel.youngs_modulus_Pa, nu = steel.poisson_ratio, G = E / (2 + 2 * nu);
  const double kappa = 6 * (1 + nu) / (7 + 6 * nu);
  const double sag =
      displacement(r, factors, node_at(r, 0, R, L / 2))[0] -
      (displacement(r, factors, node_at(r, 0, R, 0))[0] + displacement(r, factors, node_at(r, 0, R, L))[0]) /
          2;
  // Point loads, and the overhang of b/2 turns with the slope there.
  const double by_hand = span * span * span / (48 * E * inertia) + span / (4 * kappa * G * area) +
                         b / 2 * span * span / (16 * E * inertia);
  EXPECT_NEAR(sag, by_hand, 2e-3 * by_hand);  // spreading over b counts (b / L)^2 and b / 4 of the shear
  EXPECT_GT(span / (4 * kappa * G * area), 4e-3 * sag);  // so shear is seen
}

// Free, accelerated by one force in the middle: inertia loads it evenly, M = P L / 8.
TEST(Beam, InertiaBalancesASingleForce) {
  const double d = 0.04, L = 0.6, b = 0.01, R = d / 2;
  const auto r = fem::beam_responses(plain_bar(d, L),
                                     {{"middle", fem::SurfaceResultant{seat(L / 2, b, R), Component::fy}},
                                      {"gravity", fem::BodyForce{fem::BodyForce::Field::translation_y}},
                                      {"end", fem::SurfaceResultant{face(L), Component::fz}}});
  const double inertia = pi * std::pow(R, 4) / 4, moment = L / 8 - b / 8;
  const auto i = node_at(r, 0, R, L / 2);
  EXPECT_NEAR(r.stress_Pa[i * 18 + 2], moment * R / inertia, 1e-9 * R / inertia);
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(r.stress_Pa[i * 18 + 6 + c], 0, 1e-6);  // free fall
  // Pulled at one end: half the force in the middle, all of it at the end, none at the other.
  const double area = pi * R * R;
  EXPECT_NEAR(r.stress_Pa[i * 18 + 12 + 2], 0.5 / area, 1e-9 / area);
  EXPECT_NEAR(r.stress_Pa[node_at(r, 0, R, L) * 18 + 12 + 2], 1 / area, 1e-9 / area);
  EXPECT_NEAR(r.stress_Pa[node_at(r, 0, R, 0) * 18 + 12 + 2], 0, 1e-9 / area);
  EXPECT_NEAR(r.resultants[1][1], 7850 * area * L, 1e-9);
}

TEST(Beam, TorsionOfAHollowBar) {
  auto shaft = plain_bar(0.04, 0.5);
  shaft.segments[0].bore_radius_m = 0.012;
  const auto r = fem::beam_responses(shaft, {{"a", fem::SurfaceResultant{face(0), Component::torque}},
                                             {"b", fem::SurfaceResultant{face(0.5), Component::torque}}});
  const double polar = pi / 2 * (std::pow(0.02, 4) - std::pow(0.012, 4));
  const double G = steel.youngs_modulus_Pa / (2 + 2 * steel.poisson_ratio);
  const auto i = node_at(r, 0.02, 0, 0.25);
  EXPECT_NEAR(fem_tests::stress(r, {{"a", -1}, {"b", 1}}, i)[4], 0.02 / polar, 1e-9 / polar);
  const double twist = (displacement(r, {-1, 1}, node_at(r, 0.02, 0, 0.5))[1] -
                        displacement(r, {-1, 1}, node_at(r, 0.02, 0, 0))[1]) /
                       0.02;
  EXPECT_NEAR(twist, 0.5 / (G * polar), 1e-9 / (G * polar));
}

/// Stepped, bored, with an eccentric seat at an angle: nothing decouples.
fem::BeamShaft crooked_shaft() {
  fem::BeamShaft shaft;
  shaft.segments = {
      {-0.1, 0, 0.015, 0.005, 0, 0}, {0, 0.08, 0.03, 0.005, 0.004, -0.003}, {0.08, 0.2, 0.018, 0, 0, 0}};
  shaft.fillets = {{0, 0.002, 11}, {1, 0.003, 12}};
  shaft.pieces = {{0, -0.1, -0.002, 1}, {1, 0, 0.08, 2}, {2, 0.083, 0.2, 3}};
  shaft.material = steel;
  return shaft;
}

// Betti: the work of load j on response i is that of load i on response j.
TEST(Beam, Reciprocity) {
  std::vector<fem::UnitLoad> loads;
  for (const double z : {-0.1, 0.2})
    for (int c = 0; c < 6; ++c)
      loads.push_back({std::to_string(z) + std::to_string(c), fem::SurfaceResultant{face(z), Component(c)}});
  const auto r = fem::beam_responses(crooked_shaft(), loads);
  Eigen::MatrixXd work(12, 12);
  for (int end = 0; end < 2; ++end) {
    const double z = end == 0 ? -0.1 : 0.2, R = end == 0 ? 0.015 : 0.018;
    for (int k = 0; k < 12; ++k) {
      const auto at = [&](double x, double y) -> Eigen::Vector3d {
        return Eigen::Map<const Eigen::Vector3d>(
            &r.displacement_m[(node_at(r, x, y, z) * 12 + std::size_t(k)) * 3]);
      };
      const Eigen::Vector3d px = at(R, 0), mx = at(-R, 0), py = at(0, R), my = at(0, -R);
      work.col(k).segment<3>(6 * end) = (px + mx) / 2;
      work.col(k).segment<3>(6 * end + 3) << (py - my)[2] / (2 * R), -(px - mx)[2] / (2 * R),
          (px - mx)[1] / (2 * R);
    }
  }
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < i; ++j)
      // parabolas through 17 points per stretch, polynomials to the sixth degree
      EXPECT_NEAR(work(i, j), work(j, i), 1e-6 * std::sqrt(work(i, i) * work(j, j))) << i << " " << j;
}

TEST(Beam, FilletsMultiplyTheNominalStress) {
  auto shaft = crooked_shaft();
  const auto r = fem::beam_responses(shaft, {{"a", fem::SurfaceResultant{face(-0.1), Component::mx}},
                                             {"b", fem::SurfaceResultant{face(0.2), Component::mx}}});
  const fem_tests::LoadCase bent{{"a", -1}, {"b", 1}};
  const double z = -0.002 * (1 - std::sin(pi / 12));
  const double y = 0.015 + 0.002 * (1 - std::cos(pi / 12));
  const auto s = fem_tests::stress(r, bent, node_at(r, 0, y, z));
  const double nominal = 0.015 / (pi / 4 * (std::pow(0.015, 4) - std::pow(0.005, 4)));
  // Seen from the z axis along +y, the seat's surface lies at -0.003 + sqrt(0.03^2 - 0.004^2).
  const double step = -0.003 + std::sqrt(0.03 * 0.03 - 0.004 * 0.004) - 0.015;
  const double k = fem::fillet_factors(0.03, 0.03 + 2 * step, 0.002).bending;
  const double along = s[1] + s[2];  // trace in the meridian: uniaxial along the arc
  EXPECT_NEAR(along, k * nominal, 1e-9 * k * nominal);
  EXPECT_NEAR(s[0], steel.poisson_ratio * (k - 1) * nominal, 1e-9 * k * nominal);
  EXPECT_GT(fem::beam_model_error(shaft), fem::fillet_factor_error.bending);
  shaft.segments[1].axis_x_m = shaft.segments[1].axis_y_m = 0;
  EXPECT_DOUBLE_EQ(fem::beam_model_error(shaft), fem::fillet_factor_error.bending);
}

TEST(Beam, FacesLookOutwards) {
  const auto r = fem::beam_responses(crooked_shaft(), {{"a", fem::BodyForce{}}});
  ASSERT_EQ(r.nodes.n_faces(), r.nodes.face_boundary_id.size());
  const auto x = [&](std::int32_t i) { return Eigen::Map<const Eigen::Vector3d>(&r.nodes.xyz_m[3 * i]); };
  for (std::size_t f = 0; f < r.nodes.n_faces(); ++f) {
    const auto q = r.nodes.face(f);
    const Eigen::Vector3d normal = (x(q[2]) - x(q[0])).cross(x(q[3]) - x(q[1]));
    EXPECT_GT(normal.head<2>().dot(x(q[8]).head<2>()), 0) << f;
    EXPECT_LT((x(q[4]) - (x(q[0]) + x(q[1])) / 2).norm(), (x(q[1]) - x(q[0])).norm() / 2);
  }
}

TEST(Beam, RefusesWhatItCannotBe) {
  auto gap = crooked_shaft();
  gap.segments[1].begin_m = 0.01;
  EXPECT_THROW(fem::beam_responses(gap, {{"a", fem::BodyForce{}}}), std::invalid_argument);
  auto flush = crooked_shaft();
  flush.segments[1].radius_m = 0.015;
  EXPECT_THROW(fem::beam_responses(flush, {{"a", fem::BodyForce{}}}), std::invalid_argument);
  EXPECT_THROW(fem::beam_responses(crooked_shaft(), {}), std::invalid_argument);
  EXPECT_THROW(
      fem::beam_responses(crooked_shaft(), {{"a", fem::BodyForce{fem::BodyForce::Field::spin, {3}}}}),
      std::invalid_argument);
}

}  // namespace
