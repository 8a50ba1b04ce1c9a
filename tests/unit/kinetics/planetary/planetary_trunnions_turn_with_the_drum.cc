// Loads in axes that turn with the drum: what is constant on the carrier reverses fully on a trunnion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/unit/kinetics/planetary/planetary_machines.h"

namespace {

using kinetics::PlanetaryMill;

/// Size of the part of a planar force that turns with `order` times the carrier's speed, either way round.
double line(const Eigen::Array3Xd& force, int order) {
  const Eigen::Index n = force.cols();
  const double step = 2 * machines::pi / double(n);
  std::complex<double> forwards = 0, backwards = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::complex<double> f(force(0, i), force(1, i));
    forwards += f * std::polar(1.0, -order * step * double(i));
    backwards += f * std::polar(1.0, order * step * double(i));
  }
  return std::max(std::abs(forwards), order == 0 ? 0 : std::abs(backwards)) / double(n);
}

}  // namespace

// Section 5 of the specification, set B: printed to four digits.
TEST(PlanetaryTrunnions, SpectrumOfThePrintedMachine) {
  const auto mill = machines::printed_planetary();
  const auto loads = compute_loads(mill, machines::effects_without(mill, {}), {1, 360});
  const auto turned = turned_with_drum(loads, loads.resultant("trunnions")).total;
  EXPECT_NEAR(line(turned, 2), 77.490e3, 0.5);
  EXPECT_NEAR(line(turned, 1), 1.233e3, 0.5);
  EXPECT_NEAR(line(turned, 3), 0.449e3, 0.5);
  for (const int order : {0, 4, 5, 6, 7}) EXPECT_LE(line(turned, order), 1e-9 * 77e3) << order;
}

// Weights hang still in space. Seen from the drum they turn with its absolute spin against its sense,
// psi' + Omega = Omega (c - 1) / c; from a drum that does not spin (c = 1) they are constant.
TEST(PlanetaryTrunnions, WeightTurnsWithTheAbsoluteSpin) {
  for (const double c : {0.5, 1.0, 2.0, 0.25}) {
    auto mill = machines::printed_planetary();
    mill.initial_angle_rad = 0.7, mill.initial_drum_angle_rad = -0.4;
    std::get<kinetics::PlanetaryRatios>(mill.geometry).c = c;
    const auto loads = compute_loads(mill, {"drum_gravity"}, {2, 60});
    const auto seen = turned_with_drum(loads, loads.resultant("drum")).total;
    const double weight_N = 79.47 * 9.81, spin = loads.quantity("drum_speed").values[0];
    for (Eigen::Index i = 0; i < loads.n_instants(); ++i) {
      // Direction of the weight in space is -90 deg; the drum's axes have turned by phi0 + psi0 + spin t.
      const double angle = -machines::pi / 2 - (0.7 - 0.4 + spin * loads.time_s[i]);
      EXPECT_NEAR(seen(0, i), weight_N * std::cos(angle), 1e-11 * weight_N);
      EXPECT_NEAR(seen(1, i), weight_N * std::sin(angle), 1e-11 * weight_N);
    }
  }
}

TEST(PlanetaryTrunnions, SizeTorqueAndSharesAreKept) {
  const auto mill = machines::printed_planetary();
  const auto loads = compute_loads(mill, machines::effects_without(mill, {}), {1, 90});
  const auto& wall = loads.resultant("inner_wall");
  const auto turned = turned_with_drum(loads, wall);
  EXPECT_TRUE((turned.total.row(2) == wall.total.row(2)).all());
  const Eigen::ArrayXd before = wall.total.topRows<2>().matrix().colwise().norm().transpose();
  const Eigen::ArrayXd after = turned.total.topRows<2>().matrix().colwise().norm().transpose();
  EXPECT_LE((after / before - 1).abs().maxCoeff(), 1e-15);
  Eigen::Array3Xd sum = Eigen::Array3Xd::Zero(3, 90);
  for (const auto& part : turned.contributions) sum += part.load;
  EXPECT_LE((sum - turned.total).abs().maxCoeff(), 1e-14 * before.maxCoeff());
}

TEST(PlanetaryTrunnions, Period) {
  auto mill = machines::printed_planetary();
  const auto period = [&](double c) {
    std::get<kinetics::PlanetaryRatios>(mill.geometry).c = c;
    return period_in_turns(mill);
  };
  EXPECT_EQ(period(0.5), 1);
  EXPECT_EQ(period(1), 1);
  EXPECT_EQ(period(2), 2);
  EXPECT_EQ(period(0.4), 2);
  EXPECT_EQ(period(0.7), 7);
  EXPECT_EQ(period(std::sqrt(0.5)), std::nullopt);
}
