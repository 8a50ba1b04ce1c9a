/// The working shaft of the root peeler: T_34 - T_45 - D phi' = J phi'' at every instant, and forces across
/// that turn the right way.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/loads/bodies/train_shaft.h"
#include "tests/unit/pipelines/examples/plain_body.h"

namespace {

using Eigen::ArrayXd;
using pipelines::BodyLoads;

struct Peeler {
  pipelines::Scene scene = plain::scene("root_peeler_shaft");
  pipelines::LoadedBody body = plain::loaded(*scene.body("shaft"));
  pipelines::MassAgreement agreed;
  kinetics::DriveTrain train;
  kinetics::LoadHistory history;
  pipelines::TrainShaftOptions options;
  std::vector<pipelines::AttachedMass> attached;
  double speed_rad_s = 0;

  explicit Peeler(double damping_N_m_s = 0) {
    auto of_kinetics = scene.kinetics_effects();
    if (damping_N_m_s > 0) of_kinetics.push_back("inertia_damping");
    for (auto& inertia : std::get<kinetics::DriveTrain>(scene.machine).inertias)
      if (inertia.name == "working_shaft") inertia.damping_N_m_s = damping_N_m_s;
    agreed = agree_masses(scene, {plain::meshed(*scene.body("shaft"))});
    train = std::get<kinetics::DriveTrain>(agreed.machine);
    history = kinetics::compute_loads(train, of_kinetics, {16, 24});
    options = std::get<pipelines::TrainShaftOptions>(scene.body("shaft")->options);
    attached = agreed.attached.at("shaft").structure;
    speed_rad_s = kinetics::mean_speed_rad_s(train, options.inertia);
  }
  BodyLoads loads() const {
    return distribute_train_shaft(history, speed_rad_s, body, options, scene.effects, attached);
  }
};

TEST(TrainShaft, InertiaComesFromTheMesh) {
  const Peeler peeler;
  // coupling.md 7.4: 7.20e-5 kg m2, fillets included (0.1 %).
  EXPECT_NEAR(peeler.train.inertias[3].inertia_kg_m2, 7.20e-5, 0.01e-5);
  ASSERT_EQ(peeler.agreed.figures.size(), 1u);
  EXPECT_TRUE(peeler.agreed.figures[0].from_mesh);
  EXPECT_TRUE(peeler.attached.empty());
}

TEST(TrainShaft, ClosesAtEveryInstant) {
  for (const double damping : {0., 0.02}) {
    const Peeler peeler(damping);
    const auto loads = peeler.loads();
    const auto closure = bodies::closure_of(loads, peeler.body.regions);
    EXPECT_LT(closure.worst_force(), 1e-12) << damping;
    EXPECT_LT(closure.worst_moment(), 1e-12) << damping;
    // The balance itself, from the channels: T_34 - T_45 - D phi' = J phi''.
    const ArrayXd in = bodies::course(loads, "pulley_seat.torque"),
                  out = bodies::course(loads, "disc_seat.torque"),
                  drag =
                      bodies::course(loads, "bearing_1.torque") + bodies::course(loads, "bearing_2.torque"),
                  acceleration = peeler.history.quantity("working_shaft.acceleration").values;
    const double J = peeler.body.regions[0].masses.second_moments_kg_m2[0] * 2;
    EXPECT_LT(bodies::largest(in + out + drag - J * acceleration), 1e-12 * bodies::largest(in)) << damping;
    EXPECT_EQ(bodies::largest(drag) > 0, damping > 0);
    EXPECT_GT(bodies::largest(in), 1);
  }
}

// T_34 drives, counter-clockwise; the disc holds back.
// The weight along the axis, carried beside it, tilts the shaft.
TEST(TrainShaft, ClosesWithAnEccentricAxialBearing) {
  Peeler peeler;
  for (auto& port : peeler.body.ports)
    if (port.name == "pulley_seat") port.axis_x_m = 0.001;
  peeler.options.axial_bearing = "pulley_seat";
  const auto closure = bodies::closure_of(peeler.loads(), peeler.body.regions);
  EXPECT_LT(std::hypot(closure.moment[0], closure.moment[1]), 1e-12);
}

TEST(TrainShaft, TorquesAreTheElements) {
  const Peeler peeler;
  const auto loads = peeler.loads();
  const auto& first = peeler.history.resultant("working_shaft_1_on_working_shaft").total;
  const auto& second = peeler.history.resultant("working_shaft_2_on_working_shaft").total;
  EXPECT_EQ(bodies::largest(bodies::course(loads, "pulley_seat.torque") - first.row(2).transpose()), 0);
  EXPECT_EQ(bodies::largest(bodies::course(loads, "disc_seat.torque") - second.row(2).transpose()), 0);
}

TEST(TrainShaft, ForgottenTorqueIsSeen) {
  Peeler peeler;
  const double T_45 =
      bodies::largest(peeler.history.resultant("working_shaft_2_on_working_shaft").total.row(2));
  peeler.options.torques.pop_back();
  const auto loads = peeler.loads();
  const auto rest = bodies::residual(loads, peeler.body.regions);
  EXPECT_NEAR(bodies::largest(rest.row(5)), T_45, 1e-9 * T_45);
  EXPECT_GT(bodies::closure_of(loads, peeler.body.regions).worst_moment(), 0.1);
}

TEST(TrainShaft, WrongInertiaIsSeen) {
  Peeler peeler;
  auto& second_moment = peeler.body.regions[0].masses.second_moments_kg_m2[0];
  const double excess = 0.02 * second_moment;
  second_moment += excess;
  const auto rest = bodies::residual(peeler.loads(), peeler.body.regions);
  const double wanted =
      excess * bodies::largest(peeler.history.quantity("working_shaft.acceleration").values);
  EXPECT_NEAR(bodies::largest(rest.row(5)), wanted, 1e-6 * wanted);
  // A small inertia: J phi'' is 1e-5 of the torques that pass through, still a hundred times the limit.
  EXPECT_GT(bodies::closure_of(peeler.loads(), peeler.body.regions).worst_moment(), 1e-7);
}

// An inertia that the scene gives, 4 % off the mesh's: the difference sits on the pulley's seat and closes.
TEST(TrainShaft, DifferenceToAGivenInertiaIsCarried) {
  Peeler peeler;
  peeler.scene.masses_from_mesh.clear();
  auto& inertia = std::get<kinetics::DriveTrain>(peeler.scene.machine).inertias[3].inertia_kg_m2;
  inertia = 7.5e-5;
  peeler.agreed = agree_masses(peeler.scene, {plain::meshed(*peeler.scene.body("shaft"))});
  peeler.train = std::get<kinetics::DriveTrain>(peeler.agreed.machine);
  peeler.history = kinetics::compute_loads(peeler.train, peeler.scene.kinetics_effects(), {4, 24});
  peeler.attached = peeler.agreed.attached.at("shaft").structure;
  ASSERT_EQ(peeler.attached.size(), 1u);
  EXPECT_EQ(peeler.attached[0].port, "pulley_seat");
  const auto loads = peeler.loads();
  EXPECT_LT(bodies::closure_of(loads, peeler.body.regions).worst_moment(), 1e-12);
  EXPECT_GT(bodies::largest(bodies::part(loads, "shaft_inertia", "pulley_seat.torque")), 0);
}

// The belt pulls along +x of the fixed frame; seen from the shaft, which turns counter-clockwise, its pull
// turns clockwise. The imbalance stands still there.
TEST(TrainShaft, ForcesTurnTheRightWay) {
  const Peeler peeler;
  const auto loads = peeler.loads();
  EXPECT_NEAR(peeler.speed_rad_s, 510 * 2 * M_PI / 60, 1e-9);
  const ArrayXd angle =
      peeler.speed_rad_s * peeler.history.time_s + peeler.history.quantity("working_shaft.angle").values;
  EXPECT_LT(bodies::largest(bodies::part(loads, "belt_pull", "pulley_seat.fx") - 240 * angle.cos()), 1e-10);
  EXPECT_LT(bodies::largest(bodies::part(loads, "belt_pull", "pulley_seat.fy") + 240 * angle.sin()), 1e-10);
  EXPECT_LT(bodies::largest(bodies::part(loads, "disc_imbalance", "disc_seat.fx") - 860), 1e-10);
  EXPECT_EQ(bodies::largest(bodies::part(loads, "disc_imbalance", "disc_seat.fy")), 0);
  EXPECT_LT(bodies::largest(bodies::part(loads, "disc_weight", "disc_seat.fz") + 118), 1e-12);
  EXPECT_LT(bodies::largest(bodies::part(loads, "disc_weight", "bearing_1.fz") - 118), 1e-12);
}

// Bearings by levers: seat middles at z = 22.5, 52.5, 131.5, 161.5 mm.
TEST(TrainShaft, BearingsByLevers) {
  const auto loads = Peeler().loads();
  const double span = 131.5 - 52.5;
  const ArrayXd near = bodies::part(loads, "disc_imbalance", "bearing_2.fx"),
                far = bodies::part(loads, "disc_imbalance", "bearing_1.fx");
  EXPECT_LT(bodies::largest(near + 860 * (161.5 - 52.5) / span), 1e-9);
  EXPECT_LT(bodies::largest(far - 860 * (161.5 - 131.5) / span), 1e-9);
}

// A train alone gives torsion only.
TEST(TrainShaft, WithoutForcesNothingBends) {
  Peeler peeler;
  peeler.options.forces.clear();
  const auto loads = peeler.loads();
  for (const auto& channel : loads.history.channels)
    EXPECT_TRUE(channel.name.find(".torque") != std::string::npos || channel.name == "volume.az")
        << channel.name;
}

}  // namespace
