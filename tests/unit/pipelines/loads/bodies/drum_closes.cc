/// The drum of the planetary mill, set B: equilibrium at every instant, the bearing loads of coupling.md 7.3,
/// and the faults that break it.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/loads/bodies/drum.h"
#include "pipelines/loads/bodies/stub_axle.h"
#include "tests/unit/pipelines/examples/plain_body.h"

namespace {

using Eigen::ArrayXd;
using kinetics::PlanetaryConvention;
using pipelines::BodyLoads;

constexpr double drum_closed = 1e-12;

/// Set B with its drum, the masses agreed.
struct SetB {
  pipelines::Scene scene = plain::scene("planetary_mill");
  pipelines::LoadedBody body = plain::loaded(*scene.body("drum"));
  pipelines::MassAgreement agreed = agree_masses(scene, {plain::meshed(*scene.body("drum"))});

  kinetics::PlanetaryMill mill() const { return std::get<kinetics::PlanetaryMill>(agreed.machine); }
  std::vector<std::string> without(const std::string& name) const {
    auto effects = scene.effects;
    effects.erase(std::remove(effects.begin(), effects.end(), name), effects.end());
    return effects;
  }
  kinetics::LoadHistory history(const std::vector<std::string>& effects) const {
    auto of_kinetics = effects;
    of_kinetics.erase(std::remove(of_kinetics.begin(), of_kinetics.end(), "drum_spin"), of_kinetics.end());
    return kinetics::compute_loads(mill(), of_kinetics, {1, 360});
  }
  BodyLoads loads(const kinetics::LoadHistory& history, const std::vector<std::string>& effects) const {
    return distribute_drum(history, mill(), body, {effects, agreed.attached.at("drum").structure});
  }
  BodyLoads loads() const { return loads(history(scene.effects), scene.effects); }
  pipelines::Closure closure(const BodyLoads& loads) const { return bodies::closure_of(loads, body.regions); }
};

TEST(Drum, ClosesAtEveryInstant) {
  const SetB drum;
  for (const auto& effects : {drum.scene.effects, drum.without("belt"), drum.without("drum_spin"),
                              drum.without("charge_offset"), drum.without("drum_gravity")}) {
    const auto closure = drum.closure(drum.loads(drum.history(effects), effects));
    EXPECT_LT(closure.worst_force(), drum_closed);
    EXPECT_LT(closure.worst_moment(), drum_closed);
    EXPECT_EQ(closure.channel_resultant, 0);
  }
}

// Levers by hand: charge at z = 0, belt and pulley at 629 mm, bearings at +-560 mm, the mesh's mass at its
// own centre. The planar load stage knows nothing of z.
TEST(Drum, TrunnionsBalanceByLevers) {
  const SetB drum;
  const auto history = drum.history(drum.scene.effects);
  const auto loads = drum.loads(history, drum.scene.effects);
  const auto& mesh = drum.body.regions[0].masses;
  const double l_OA = kinetics::planetary_geometry(drum.mill()).carrier_m;
  Eigen::Array2Xd a(2, history.n_instants());  // Omega^2 l_OA e_x + G
  a.row(0) = 900 * l_OA - 9.81 * history.phi_rad.sin().transpose();
  a.row(1) = -9.81 * history.phi_rad.cos().transpose();
  const auto wall = history.resultant("inner_wall").total.topRows<2>(),
             belt = history.resultant("pulley").total.topRows<2>();
  const double m_mesh = mesh.mass_kg, s_mesh = mesh.first_moment_kg_m[2], m_p = 79.47 - m_mesh;
  // Moments about trunnion 1, at z = -0.56.
  const Eigen::Array2Xd second =
      -(0.56 * wall + (0.56 + 0.629) * (belt + m_p * a) + (0.56 * m_mesh + s_mesh) * a) / 1.12;
  const Eigen::Array2Xd first = -(wall + belt + 79.47 * a) - second;
  const ArrayXd back = -history.quantity("psi").values;
  for (const auto& [port, wanted] : {std::pair{"trunnion_1", first}, {"trunnion_2", second}}) {
    const auto got = pipelines::turned(bodies::force(loads, port), back);
    EXPECT_LT(bodies::largest(got - wanted), drum_closed * bodies::largest(wanted)) << port;
  }
  // coupling.md 7.3 prints 55.2 kN (plain side) and 23.7 kN (pulley side). How the mesh's mass lies along z
  // moves 0.73 kN per kg m between the two: 1 %.
  EXPECT_NEAR(bodies::magnitude(bodies::force(loads, "trunnion_1")).maxCoeff(), 55.2e3, 0.01 * 55.2e3);
  EXPECT_NEAR(bodies::magnitude(bodies::force(loads, "trunnion_2")).maxCoeff(), 23.7e3, 0.01 * 23.7e3);
}

// Their sum is (-X_A, Y_A), turned into the drum's axes by psi.
TEST(Drum, TrunnionsAddUpToTheLoadOnTheAxle) {
  const SetB drum;
  const auto history = drum.history(drum.scene.effects);
  const auto loads = drum.loads(history, drum.scene.effects);
  const ArrayXd psi = history.quantity("psi").values, X = history.quantity("X_A").values,
                Y = history.quantity("Y_A").values;
  const auto sum = (bodies::force(loads, "trunnion_1") + bodies::force(loads, "trunnion_2")).eval();
  const ArrayXd xi = -psi.cos() * X + psi.sin() * Y, eta = psi.sin() * X + psi.cos() * Y;
  const double size = bodies::largest(X);
  EXPECT_LT(bodies::largest(sum.row(0).transpose() - xi), drum_closed * size);
  EXPECT_LT(bodies::largest(sum.row(1).transpose() - eta), drum_closed * size);
}

TEST(Drum, WallTorqueBalancesTheBelt) {
  const SetB drum;
  const auto history = drum.history(drum.scene.effects);
  const auto loads = drum.loads(history, drum.scene.effects);
  const ArrayXd wall = bodies::course(loads, "inner_wall.torque").abs();
  EXPECT_NEAR(wall.minCoeff(), 1567, 1);
  EXPECT_NEAR(wall.maxCoeff(), 1627, 1);
  EXPECT_LT(bodies::largest(bodies::course(loads, "inner_wall.torque") - history.quantity("M_A").values),
            drum_closed * wall.maxCoeff());
}

TEST(Drum, ForgottenWallTorqueIsSeen) {
  const SetB drum;
  auto history = drum.history(drum.scene.effects);
  for (auto& resultant : history.resultants)
    if (resultant.role == "inner_wall")
      for (auto& part : resultant.contributions) part.load.row(2).setZero();
  const auto loads = drum.loads(history, drum.scene.effects);
  EXPECT_LT(drum.closure(loads).worst_force(), drum_closed);
  EXPECT_NEAR(bodies::largest(bodies::residual(loads, drum.body.regions).row(5)), 1627, 1);
}

// A mass that load stage and mesh do not agree on, left uncorrected: 1 % of m_A Omega^2 l_OA, and g.
TEST(Drum, WrongMassIsSeen) {
  SetB drum;
  drum.body.regions[0].masses.mass_kg += 0.7947;
  const auto loads = drum.loads();
  EXPECT_GT(drum.closure(loads).worst_force(), 1e-3);
  const auto rest = bodies::residual(loads, drum.body.regions).topRows<2>().eval();
  const double l_OA = kinetics::planetary_geometry(drum.mill()).carrier_m;
  EXPECT_NEAR(bodies::magnitude(rest).maxCoeff(), 0.7947 * (900 * l_OA + 9.81), 1e-6);
}

// The drum turns by psi. Torques do not turn; everything else alike: only what pulls off the axis is missed,
// so that forces still close. What tells is where they point: the load of the axle stands almost still in the
// carrier's frame.
TEST(Drum, TurnedByTheWrongSignPointsElsewhere) {
  const SetB drum;
  const auto right = drum.history(drum.scene.effects);
  auto wrong = right;
  for (auto& quantity : wrong.quantities)
    if (quantity.name == "psi") quantity.values *= -1;
  const auto drift = [&](const kinetics::LoadHistory& turned_by) {
    const auto loads = drum.loads(turned_by, drum.scene.effects);
    const auto sum = (bodies::force(loads, "trunnion_1") + bodies::force(loads, "trunnion_2")).eval();
    const auto back = pipelines::turned(sum, -right.quantity("psi").values);
    const auto wanted = right.resultant("trunnions").total.topRows<2>();
    return bodies::largest(back - wanted) / bodies::largest(wanted);
  };
  EXPECT_LT(drift(right), drum_closed);
  EXPECT_GT(drift(wrong), 1);
}

// With the belt off an outer couple -M_A takes its place on the pulley's seat.
TEST(Drum, DriveCoupleReplacesTheBelt) {
  const SetB drum;
  const auto effects = drum.without("belt");
  const auto history = drum.history(effects);
  const auto loads = drum.loads(history, effects);
  EXPECT_LT(bodies::largest(bodies::part(loads, "drive_couple", "pulley_seat.torque") +
                            history.quantity("M_A").values),
            drum_closed * 1627);
  EXPECT_EQ(bodies::largest(bodies::part(loads, "belt", "pulley_seat.fx")), 0);
  EXPECT_EQ(bodies::largest(bodies::part(loads, "drive_couple", "pulley_seat.fx")), 0);
}

// Spin strains the drum and loads nothing: a channel without a resultant, no bearing feels it.
TEST(Drum, SpinAddsStressOnly) {
  const SetB drum;
  const auto with = drum.loads();
  const auto effects = drum.without("drum_spin");
  const auto without = drum.loads(drum.history(effects), effects);
  ASSERT_TRUE(bodies::has(with, "volume.spin"));
  EXPECT_FALSE(bodies::has(without, "volume.spin"));
  const double omega = -30;  // (c - 1) / c Omega, c = 0.5
  EXPECT_NEAR(bodies::largest(bodies::course(with, "volume.spin")), omega * omega, 1e-9);
  EXPECT_EQ(with.history.channels.size(), without.history.channels.size() + 1);
  for (const auto& channel : without.history.channels)
    EXPECT_LT(bodies::largest(bodies::course(with, channel.name) - bodies::course(without, channel.name)),
              1e-9 * (1 + bodies::largest(bodies::course(without, channel.name))))
        << channel.name;
}

// A mesh knows the drum's axis to round-off: what is left of the first moment is no measure of the field.
TEST(Drum, SpinIsKeptOnAMeshThatIsRoundToRoundOff) {
  SetB drum;
  for (const double moment_kg_m : {1e-17, 1e-13}) {
    drum.body.regions[0].masses.first_moment_kg_m[0] = moment_kg_m;
    const auto loads = drum.loads();
    EXPECT_TRUE(bodies::has(loads, "volume.spin")) << moment_kg_m;
    EXPECT_GT(bodies::largest(bodies::part(loads, "drum_spin", "volume.spin")), 899) << moment_kg_m;
  }
}

kinetics::LoadHistory of_convention(kinetics::PlanetaryMill& mill, PlanetaryConvention convention) {
  mill.convention = convention;
  std::vector<std::string> effects;
  for (const auto& effect : kinetics::planetary_mill_effects(convention)) effects.push_back(effect.name);
  return kinetics::compute_loads(mill, effects, {1, 360});
}

// coupling.md section 1: as_published leaves 1.4 % of the force and 0.4 % of the moment.
TEST(Drum, ConventionThatDoesNotCloseIsRefusedWithItsFigure) {
  const SetB drum;
  auto mill = drum.mill();
  const auto published = of_convention(mill, PlanetaryConvention::as_published);
  try {
    distribute_drum(published, mill, drum.body, {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("\"as_published\" leaves 1.4"), std::string::npos) << text;
    EXPECT_NE(text.find("% of the forces and 0.39"), std::string::npos) << text;
    EXPECT_NE(text.find("\"consistent\""), std::string::npos) << text;
  }
  EXPECT_THROW(distribute_stub_axle(published, mill, drum.body, {}, {}), std::invalid_argument);
}

// At c = 0.5 the plotted reading is the consistent one.
TEST(Drum, AsPlottedIsAcceptedWhereItCloses) {
  const SetB drum;
  auto mill = drum.mill();
  const auto history = of_convention(mill, PlanetaryConvention::as_plotted);
  const auto& effects = history.effects;
  const auto loads =
      distribute_drum(history, mill, drum.body, {effects, drum.agreed.attached.at("drum").structure});
  const auto closure = drum.closure(loads);
  EXPECT_LT(closure.worst_force(), drum_closed);
  EXPECT_LT(closure.worst_moment(), drum_closed);
}

}  // namespace
