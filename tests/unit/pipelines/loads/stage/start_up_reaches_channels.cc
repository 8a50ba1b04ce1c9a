/// The start of the root peeler's shaft: its loads close at every instant, turn by the true angle, and share
/// the channels of steady running.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/loads/bodies/train_shaft.h"
#include "pipelines/loads/stage/start_up_loads.h"
#include "pipelines/scene/machines/drive_train_reader.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "tests/unit/pipelines/examples/edited_scene.h"
#include "tests/unit/pipelines/examples/plain_body.h"

namespace {

using Eigen::ArrayXd;
using pipelines::BodyLoads;
using pipelines::kind_of;

struct StartingPeeler {
  pipelines::Scene scene;
  const pipelines::BodyScene& body = *scene.body("shaft");
  pipelines::MeshedBody meshed = plain::meshed(body);
  pipelines::MassAgreement masses = agree_masses(scene, {meshed});
  kinetics::LoadHistory start;

  explicit StartingPeeler(const edited::Edits& edits = {})
      : scene(edited::scene("root_peeler_shaft", edits)) {
    start = kind_of(masses.machine).start_up(scene, masses.machine).value();
  }
  BodyLoads loads() const { return loads_over(scene, body, start, meshed, masses); }
  BodyLoads steady() const {
    return distribute_body(scene, body, kind_of(masses.machine).loads(scene, masses.machine),
                           loaded_body(body, meshed), masses);
  }
};

const edited::Edits balanced_constants{
    {"harmonics = [{ amplitude = \"3.744 N m\", frequency = \"50 Hz\" }]", ""},
    {"harmonics = [{ amplitude = \"-9.6 N m\", frequency = \"50 Hz\" }]", ""}};

}  // namespace

TEST(StartUp, ClosesAtEveryInstant) {
  const StartingPeeler peeler;
  const auto loads = peeler.loads();
  ASSERT_EQ(loads.history.values.cols(), 2501) << "1 s by 0.1 ms, every fourth step";
  const auto closure = bodies::closure_of(loads, peeler.meshed.regions);
  EXPECT_LT(closure.worst_force(), 1e-12);
  EXPECT_LT(closure.worst_moment(), 1e-12);
  // T_34 - T_45 = J phi'': the torques are not those of steady running, and the shaft speeds up.
  const ArrayXd in = bodies::course(loads, "pulley_seat.torque"),
                out = bodies::course(loads, "disc_seat.torque"),
                acceleration = peeler.start.quantity("working_shaft.acceleration").values;
  const double J = peeler.meshed.regions[0].masses.second_moments_kg_m2[0] * 2;
  EXPECT_LT(bodies::largest(in + out - J * acceleration), 1e-12 * bodies::largest(in));
  EXPECT_GT(in.maxCoeff(), 30) << "2.2 times the rated 9.984 N m, and more";
  EXPECT_EQ(peeler.start.quantity("closure").values.size(), 2501);
  EXPECT_LT(peeler.start.quantity("closure").values.maxCoeff(), 1e-9);
}

// The belt stands still in space: seen from the shaft it turns by the integral of the speed, 55 rad in the
// end less than a shaft that ran at its 510 rpm from the beginning.
TEST(StartUp, ForcesTurnByTheTrueAngle) {
  const StartingPeeler peeler;
  const auto loads = peeler.loads();
  const auto motion = transient(std::get<kinetics::DriveTrain>(peeler.masses.machine),
                                pipelines::transient_run(peeler.scene.torsion))
                          .motion;
  const ArrayXd angle = motion.angle_rad.row(3).transpose();
  ASSERT_EQ(angle.size(), loads.history.values.cols());
  // Two runs of 10 000 steps, summed from parts or not.
  EXPECT_LT(bodies::largest(bodies::part(loads, "belt_pull", "pulley_seat.fx") - 240 * angle.cos()), 1e-6);
  EXPECT_LT(bodies::largest(bodies::part(loads, "belt_pull", "pulley_seat.fy") + 240 * angle.sin()), 1e-6);
  const double at_the_end = angle[angle.size() - 1], uniform = 510 * 2 * M_PI / 60;
  // By hand: 0.345 of the way while the speed rises evenly by 0.76 s, all of it after that.
  EXPECT_LT(at_the_end, 0.75 * uniform);
  EXPECT_GT(at_the_end, 0.5 * uniform);
}

TEST(StartUp, PartsAddUpToTheChannels) {
  const auto loads = StartingPeeler().loads();
  Eigen::ArrayXXd rest = loads.history.values;
  for (const auto& part : loads.history.by_effect) rest -= part;
  EXPECT_LT(bodies::largest(rest), 1e-9 * bodies::largest(loads.history.values));
  // The roots' 9.984 N m mostly slow the disc itself: the shaft brings what accelerates motor and pulleys,
  // their share of all inertia. The torque rises within sixty periods, and shakes the shaft by 1 / (w 0.76 s)
  // = 0.3 %.
  const double beyond = (1.302315e-3 + 3.86275e-4) / (0.375 * 0.375) + 2.460168e-2, J_2 = 7.2e-5 + 0.2099853;
  const double wanted = 9.984 * beyond / (beyond + J_2);
  EXPECT_NEAR(bodies::largest(bodies::part(loads, "transient_torque_on_disc", "pulley_seat.torque")), wanted,
              0.005 * wanted);
  EXPECT_GT(bodies::largest(bodies::part(loads, "transient_torque_on_rotor", "pulley_seat.torque")), 30);
  EXPECT_EQ(bodies::largest(bodies::part(loads, "motor_torque", "pulley_seat.torque")), 0)
      << "excitations = false";
}

// Torques that balance accelerate nothing: the steady shaft lacks a channel that its start has.
TEST(StartUp, SharesItsChannelsWithSteadyRunning) {
  const StartingPeeler peeler(balanced_constants);
  auto steady = peeler.steady(), start = peeler.loads();
  const auto before = steady, start_before = start;
  ASSERT_FALSE(bodies::has(steady, "volume.az"));
  ASSERT_TRUE(bodies::has(start, "volume.az"));
  join_channels(steady, start);
  ASSERT_EQ(steady.history.channels.size(), start.history.channels.size());
  ASSERT_EQ(steady.unit_loads.size(), steady.history.channels.size());
  for (std::size_t k = 0; k < steady.history.channels.size(); ++k)
    EXPECT_EQ(steady.history.channels[k].name, start.history.channels[k].name);
  EXPECT_EQ(bodies::largest(bodies::course(steady, "volume.az")), 0);
  for (const auto& channel : before.history.channels)
    EXPECT_EQ(bodies::largest(bodies::course(steady, channel.name) - bodies::course(before, channel.name)),
              0);
  for (const auto& channel : start_before.history.channels)
    EXPECT_EQ(
        bodies::largest(bodies::course(start, channel.name) - bodies::course(start_before, channel.name)), 0);
  for (const auto* loads : {&steady, &start}) {
    const auto closure = bodies::closure_of(*loads, peeler.meshed.regions);
    EXPECT_LT(closure.worst_moment(), 1e-12);
    EXPECT_LT(closure.worst_force(), 1e-12);
  }
}

TEST(StartUp, IsThereWhereTheSceneAsksForIt) {
  for (const char* name : {"vibratory_mill", "load_table"}) {
    const auto scene = plain::scene(name);
    EXPECT_FALSE(kind_of(scene.machine).start_up(scene, scene.machine)) << name;
  }
  auto scene = plain::scene("root_peeler_shaft");
  EXPECT_TRUE(kind_of(scene.machine).start_up(scene, scene.machine));
  scene.torsion.transient.reset();
  EXPECT_FALSE(kind_of(scene.machine).start_up(scene, scene.machine));
}
