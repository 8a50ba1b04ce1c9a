// Clamped rods: loads act as they are, displacement is that in space, and clamps that do not hold a body are
// refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;
constexpr double length_m = 0.2, area_m2 = 3.14159265358979 * 0.025 * 0.025;

struct Clamps : testing::Test {
  static void SetUpTestSuite() { rod = new fem_tests::ShaftBody(fem_tests::rod(8)); }
  static void TearDownTestSuite() { delete rod; }
  static fem::Clamp end_1(std::array<bool, 3> fixed) {
    return {rod->ports.at("end_1").boundary_id, fixed, {}};
  }
  static std::string refusal(const std::vector<fem::Clamp>& clamps,
                             const std::vector<fem::ElasticSupport>& springs = {}) {
    auto body = rod->body;
    body.clamps = clamps;
    body.elastic_supports = springs;
    try {
      fem::Model(body).unit_responses({fem_tests::resultant(*rod, "end_2", Component::fz)}, {});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }
  static fem_tests::ShaftBody* rod;
};
fem_tests::ShaftBody* Clamps::rod;

void expect_all_words(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

// Without Poisson's ratio the held end does not matter: u_z = F z / (E A), sigma_z = F / A. The body force of
// a uniform acceleration has u_z = rho a z (L - z / 2) / E; a free body would not feel it at all.
TEST_F(Clamps, StretchedRods) {
  auto body = rod->body;
  body.material = {200e9, 0, 7850};
  for (const int degree : {1, 2, 3}) {
    body.degree = degree;
    body.clamps = {end_1({true, true, true})};
    const auto r =
        fem::Model(body).unit_responses({fem_tests::resultant(*rod, "end_2", Component::fz),
                                         {"rod.az", fem::BodyForce{fem::BodyForce::Field::translation_z}}},
                                        {});
    const double volume = fem::Model(body).mass_properties().volume_m3, e_Pa = 200e9;
    EXPECT_NEAR(volume / (length_m * area_m2), 1, degree == 1 ? 0.11 : 1e-3);  // eight sectors
    const double force_scale = length_m / (e_Pa * volume / length_m),
                 weight_scale = 7850 * length_m * length_m / (2 * e_Pa);
    for (std::size_t i = 0; i < r.nodes.n; ++i) {
      const double z = r.nodes.xyz_m[3 * i + 2];
      const double *pulled = &r.displacement_m[2 * i * 3], *heavy = &r.displacement_m[(2 * i + 1) * 3];
      // Exact up to the solver's rounding; linear cells meet the parabola at their nodes.
      EXPECT_NEAR(pulled[2], force_scale * z / length_m, 1e-8 * force_scale);
      EXPECT_NEAR(heavy[2], weight_scale * z / length_m * (2 - z / length_m), 1e-8 * weight_scale);
      EXPECT_NEAR(pulled[0], 0, 1e-8 * force_scale);
      EXPECT_NEAR(r.stress_Pa[2 * i * 6 + 2] * volume / length_m, 1, 1e-6);
      if (z > 0) continue;
      for (int d = 0; d < 3; ++d) EXPECT_EQ(pulled[d], 0);
    }
  }
}

// Held at the points that carry nothing, a body under balanced loads is as stressed as a free one.
TEST_F(Clamps, BalancedLoadsDoNotFeelADeterminateHold) {
  const std::vector<fem::UnitLoad> loads = {fem_tests::resultant(*rod, "end_1", Component::torque),
                                            fem_tests::resultant(*rod, "end_2", Component::torque)};
  const fem_tests::LoadCase twist = {{"end_1.torque", -1}, {"end_2.torque", 1}};
  const auto free = fem::Model(rod->body).unit_responses(loads, {});
  auto body = rod->body;
  body.clamps = {end_1({true, true, true})};  // torsion of a round rod leaves its sections plane
  const auto held = fem::Model(body).unit_responses(loads, {}, fem::Recovery::average);
  const auto reference = fem::Model(rod->body).unit_responses(loads, {}, fem::Recovery::average);
  double scale = 0;
  for (const double s : free.stress_Pa) scale = std::max(scale, std::abs(s));
  for (std::size_t i = 0; i < held.nodes.n; ++i) {
    const auto ours = fem_tests::stress(held, twist, i), theirs = fem_tests::stress(reference, twist, i);
    // The meshed end turns as a rigid disc only as far as its discrete traction is Saint-Venant's.
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(ours[c], theirs[c], 2e-3 * scale);
  }
}

TEST_F(Clamps, ALineOfNodesHoldsWithOthers) {
  auto body = rod->body;
  const int side = rod->ports.at("rod").boundary_id;
  body.clamps = {{side, {true, true, true}, 0.0}};  // the rim of the lower end
  const auto r = fem::Model(body).unit_responses({fem_tests::resultant(*rod, "end_2", Component::fz)}, {});
  int held = 0;
  double largest = 0;
  for (std::size_t i = 0; i < r.nodes.n; ++i) {
    const double* u = &r.displacement_m[3 * i];
    const double* x = &r.nodes.xyz_m[3 * i];
    largest = std::max(largest, std::abs(u[2]));
    if (x[2] > 1e-12 || std::hypot(x[0], x[1]) < 0.025 - 1e-9) continue;
    ++held;
    EXPECT_EQ(u[2], 0);
  }
  EXPECT_EQ(held, 16);  // corners and middles of eight sectors
  EXPECT_GT(largest, length_m / (206e9 * area_m2));
}

TEST_F(Clamps, Refusals) {
  expect_all_words(refusal({{987, {true, true, true}, {}}}), {"group 987", "no faces"});
  expect_all_words(refusal({end_1({false, false, false})}), {"fixes no direction"});
  auto nowhere = end_1({true, true, true});
  nowhere.only_at_z_m = 0.05;
  expect_all_words(refusal({nowhere}), {"z = 0.05", "row of nodes"});
  // Held within its plane, the end still lets the rod turn out of it; held round about, it slips along z.
  expect_all_words(refusal({end_1({false, false, true})}), {"rigid motion"});
  expect_all_words(refusal({end_1({true, true, false})}), {"rigid motion"});
  expect_all_words(refusal({{rod->ports.at("rod").boundary_id, {true, true, false}, {}}}),
                   {"rigid motion", "translation (0, 0, 1) with rotation (0, 0, 0)"});
  const fem::ElasticSupport spring{rod->ports.at("end_2"), {1e6, 1e6, 1e6}};
  expect_all_words(refusal({end_1({true, true, true})}, {spring}), {"clamps", "elastic supports"});
  EXPECT_EQ(refusal({end_1({true, true, true})}), "accepted");
}

// Half the ring pushes the rod sideways; without its resultants it would not.
TEST_F(Clamps, PressureMayKeepItsResultants) {
  auto body = rod->body;
  body.clamps = {end_1({true, true, true})};
  auto seat = rod->ports.at("rod");
  fem::SeatPressure load{seat, 2, 1, fem::SeatPressure::Phase::cosine};
  seat.centre_m[0] = 0.01;  // an angle about another axis than the rod's: the harmonic has a resultant
  load.surface = seat;
  auto kept = load;
  kept.keeps_resultants = true;
  const auto r = fem::Model(body).unit_responses({{"rod.p2", load}, {"rod.p2_kept", kept}}, {});
  for (const double f : r.resultants[0]) EXPECT_NEAR(f, 0, 1e-12);
  EXPECT_GT(std::abs(r.resultants[1][0]), 0.1);
}

}  // namespace
