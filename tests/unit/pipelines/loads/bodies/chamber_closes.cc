/// The chamber of the laboratory mill is in equilibrium at every instant, with every choice of effects; the
/// faults of coupling.md section 3 each break that by the size which stands there.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/loads/stage/load_maker.h"
#include "pipelines/loads/stage/machine_masses.h"
#include "tests/unit/pipelines/examples/chamber_body.h"

namespace {

using Eigen::ArrayXd;

// The load stage closes to 1e-15 of the forces; the moments' scale is that of B at the arms of the feet.
constexpr double closed = 1e-12;

void expect_closed(const chamber::Loaded& result, const std::string& what) {
  EXPECT_LT(result.closure.worst_force(), closed) << what;
  EXPECT_LT(result.closure.worst_moment(), closed) << what;
  EXPECT_EQ(result.closure.channel_resultant, 0) << what;
}

TEST(Chamber, ClosesAtEveryInstant) {
  expect_closed(chamber::distribute(chamber::spec_effects()), "all");
  expect_closed(chamber::distribute(chamber::effects_without({"charge_lag"})), "charge follows the pitch");
  expect_closed(chamber::distribute(chamber::effects_without({})), "lag too");
  const std::vector<std::string> charge{"gravity_charge", "charge_translation", "charge_centripetal",
                                        "charge_coriolis", "charge_relative"};
  const auto empty = chamber::distribute(chamber::spec_effects(charge));
  expect_closed(empty, "charge off");
  EXPECT_FALSE(bodies::has(empty.loads, "inner_wall.fx")) << "a wall without a charge has no channel";
  expect_closed(chamber::distribute(chamber::spec_effects({"structure_inertia"})), "no structure inertia");
  expect_closed(chamber::distribute(chamber::spec_effects({"gravity_structure", "gravity_exciter"})),
                "weightless");
}

// coupling.md, table of section 3: what enters where, in the axes of the fixed frame.
TEST(Chamber, ChannelsAreTheLoadStages) {
  const auto [history, loads, closure] = chamber::distribute(chamber::effects_without({"charge_lag"}));
  const auto m = chamber::mill();
  const ArrayXd phi = history.phi_rad;
  const double a = m.eccentricity_m * m.speed_rad_s * m.speed_rad_s;
  // -s'' = ecc omega^2 e(phi), e = (cos phi, -sin phi); gravity down; -theta''.
  for (const std::string region : {"structure", "exciter"}) {
    const std::string inertia = region + "_inertia", weight = "gravity_" + region, at = "volume." + region;
    EXPECT_LT(bodies::largest(bodies::part(loads, inertia, at + ".ax") - a * phi.cos()), 1e-12 * a);
    EXPECT_LT(bodies::largest(bodies::part(loads, inertia, at + ".ay") + a * phi.sin()), 1e-12 * a);
    EXPECT_LT(bodies::largest(bodies::part(loads, weight, at + ".ay") + 9.81), 1e-14);
    EXPECT_LT(
        bodies::largest(bodies::part(loads, "pitch", at + ".az") + history.quantity("theta_ddot").values),
        1e-12 * bodies::largest(history.quantity("theta_ddot").values));
  }
  const auto& wall = history.resultant("inner_wall").total;
  EXPECT_LT(bodies::largest(bodies::force(loads, "inner_wall") - wall.topRows<2>()), 1e-9);
  EXPECT_LT(bodies::largest(bodies::course(loads, "inner_wall.torque") - wall.row(2).transpose()), 1e-10);
  // r e(chi) x F_w, chi clockwise; what follows the pitch acts at C and has no torque.
  const ArrayXd chi = history.quantity("chi").values, r_x = 0.03 * chi.cos(), r_y = -0.03 * chi.sin();
  ArrayXd f_x = wall.row(0), f_y = wall.row(1);
  f_x -= bodies::part(loads, "charge_follows_pitch", "inner_wall.fx");
  f_y -= bodies::part(loads, "charge_follows_pitch", "inner_wall.fy");
  EXPECT_LT(bodies::largest(bodies::course(loads, "inner_wall.torque") - (r_x * f_y - r_y * f_x)), 1e-9);
  EXPECT_GT(bodies::largest(bodies::part(loads, "charge_follows_pitch", "inner_wall.fx")), 1);
  const auto& bore = history.resultant("housing_bore").total;
  EXPECT_LT(bodies::largest(bodies::force(loads, "housing_bore") - bore.topRows<2>()), 1e-9);
  EXPECT_FALSE(bodies::has(loads, "housing_bore.torque")) << "a bearing carries no torque";
}

// Pressure on the wall points along F_w, whatever way the charge's centre lies.
TEST(Chamber, WallPressureFollowsTheForceNotTheCharge) {
  const auto [history, loads, closure] = chamber::distribute(chamber::spec_effects());
  const auto& wall = history.resultant("inner_wall").total;
  const ArrayXd size = bodies::magnitude(wall.topRows<2>());
  const ArrayXd p2c = bodies::course(loads, "inner_wall.p2c"), p2s = bodies::course(loads, "inner_wall.p2s");
  double against = 0;
  const ArrayXd chi = history.quantity("chi").values;
  for (Eigen::Index i = 0; i < size.size(); ++i) {
    const double beta = std::atan2(wall(1, i), wall(0, i));
    EXPECT_NEAR(p2c[i], size[i] * std::cos(2 * beta), 1e-9 * size[i]);
    EXPECT_NEAR(p2s[i], size[i] * std::sin(2 * beta), 1e-9 * size[i]);
    against = std::min(against, wall(0, i) * std::cos(chi[i]) - wall(1, i) * std::sin(chi[i]));
  }
  EXPECT_NEAR(against, -2000, 60) << "coupling.md: a sector at chi would have to pull with 2.0 kN";
}

// Figures of coupling.md's table, printed with two or three digits.
TEST(Chamber, ForgottenWallTorqueLeaves61Nm) {
  const auto effects = chamber::spec_effects();
  const auto body = chamber::body();
  auto history = kinetics::compute_loads(chamber::mill(), effects, {20, 720});
  for (auto& resultant : history.resultants)
    if (resultant.role == "inner_wall")
      for (auto& part : resultant.contributions) part.load.row(2).setZero();
  const chamber::Loaded result{
      history, distribute_chamber(history, chamber::mill(), body, {effects, {}, {}, {}}), {}};
  EXPECT_LT(chamber::open_force(result, body), 1e-8);
  EXPECT_NEAR(chamber::open_couple(result, body), 61.2, 0.1);
}

TEST(Chamber, MassOnePercentTooLargeLeavesForceAndMoment) {
  auto body = chamber::body();
  auto& m = body.regions[0].masses;
  m.mass_kg *= 1.01;
  for (double& s : m.first_moment_kg_m) s *= 1.01;
  const auto result = chamber::distribute(chamber::spec_effects(), body);
  // 1 % of m1 (-s'' + g - theta'' z x l).
  const auto& h = result.history;
  const ArrayXd turn = h.quantity("theta_ddot").values;
  const double a = 0.004 * 151.844 * 151.844;
  const ArrayXd x = a * h.phi_rad.cos() + turn * 0.02, y = -a * h.phi_rad.sin() - 9.81 - turn * 0.26;
  const double wanted = 0.3 * (x.square() + y.square()).sqrt().maxCoeff();
  EXPECT_NEAR(chamber::open_force(result, body), wanted, 1e-9 * wanted);
  EXPECT_NEAR(chamber::open_couple(result, body), 8.0, 0.1);
  EXPECT_GT(result.closure.worst_force(), 2.2e-3);
  EXPECT_NEAR(result.closure.worst_moment(), 0.003, 0.0005);
}

TEST(Chamber, PitchInertiaFourPercentTooLargeLeaves55Nm) {
  auto body = chamber::body();
  body.regions[0].masses.second_moments_kg_m2[0] += 0.04 * 2.85;
  const auto result = chamber::distribute(chamber::spec_effects(), body);
  EXPECT_LT(chamber::open_force(result, body), 1e-8);
  EXPECT_NEAR(chamber::open_couple(result, body), 55, 0.5);
  EXPECT_GT(result.closure.worst_moment(), 0.01);
}

// A load turned into the chamber's pitch, or the pitch taken the wrong way round, is no small matter either.
TEST(Chamber, PitchTheWrongWayRoundIsSeen) {
  const auto effects = chamber::spec_effects();
  const auto body = chamber::body();
  auto history = kinetics::compute_loads(chamber::mill(), effects, {20, 72});
  for (auto& quantity : history.quantities)
    if (quantity.name == "theta_ddot") quantity.values *= -1;
  const auto loads = distribute_chamber(history, chamber::mill(), body, {effects, {}, {}, {}});
  EXPECT_GT(bodies::closure_of(loads, body.regions).worst_moment(), 0.1);
}

TEST(Chamber, PublishedConventionIsRefused) {
  auto mill = chamber::mill();
  mill.convention = kinetics::Convention::published;
  const auto history = kinetics::compute_loads(mill, {"gravity_structure", "springs"}, {1, 24});
  EXPECT_THROW(distribute_chamber(history, mill, chamber::body(), {}), std::invalid_argument);
}

TEST(Chamber, MissingFootIsNamed) {
  auto body = chamber::body();
  body.ports.pop_back();
  try {
    chamber::distribute(chamber::spec_effects(), body);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("spring_foot_2"), std::string::npos) << error.what();
  }
}

// A file's foot 0.5 mm beside the machine's spring would leave 0.5 N m open; what is off is said, not which
// effect.
TEST(Chamber, PortsElsewhereThanTheMachinesAreNamed) {
  auto scene = laboratory::scene();
  scene.effects = chamber::spec_effects();
  const auto& body = *scene.body("chamber");
  pipelines::MassAgreement masses{scene.machine, {}, {}};
  masses.attached["chamber"];
  const auto history = kinetics::compute_loads(chamber::mill(), scene.effects, {20, 72});
  const auto refusal = [&](const pipelines::LoadedBody& loaded) -> std::string {
    try {
      load_maker_of(body).distribute(scene, body, history, loaded, masses);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  auto loaded = chamber::body();
  EXPECT_EQ(refusal(loaded), "accepted");
  loaded.ports.back().axis_y_m -= 0.5e-3;
  const auto text = refusal(loaded);
  EXPECT_NE(text.find("port \"spring_foot_2\" is at (460, -180.5) mm, where machine.springs[2].position is "
                      "(460, -180) mm"),
            std::string::npos)
      << text;
}

// The charge at one end: a pressure that rises along the wall acts a sixth of its length beside the middle.
TEST(Chamber, AChargeAtOneEndTiltsIt) {
  auto body = chamber::body();
  body.pressures["inner_wall"].axial_profile = {0, 1};
  const auto result = chamber::distribute(chamber::spec_effects(), body);
  expect_closed(result, "charge at the front");
  const auto& wall = result.history.resultant("inner_wall").total;
  EXPECT_LT(
      bodies::largest(bodies::course(result.loads, "inner_wall.my") - wall.row(0).transpose() * 0.21 / 6),
      1e-9);
  EXPECT_LT(
      bodies::largest(bodies::course(result.loads, "inner_wall.mx") + wall.row(1).transpose() * 0.21 / 6),
      1e-9);
}

}  // namespace
