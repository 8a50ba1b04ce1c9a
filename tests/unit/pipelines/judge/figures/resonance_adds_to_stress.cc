/// What resonance adds to a stress computed without it: closed forms of one and two harmonics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipelines/judge/figures/vibration.h"

namespace {

using pipelines::dynamic_amplification;

constexpr int n = 240, turns = 2;
constexpr double turn_Hz = 10;

/// Tension along z: a constant and cosines of some orders.
Eigen::ArrayXXd tension(double mean, const std::vector<std::pair<int, double>>& harmonics) {
  Eigen::ArrayXXd stress = Eigen::ArrayXXd::Zero(6, n);
  for (int i = 0; i < n; ++i) {
    stress(2, i) = mean;
    for (const auto& [order, amplitude] : harmonics)
      stress(2, i) += amplitude * std::cos(2 * M_PI * turns * order * i / n + 0.3 * order);
  }
  return stress;
}

double amplified(double ratio) {
  return std::abs(1 / (1 - ratio * ratio)) - 1;
}

// 1e-12: sums of 240 terms.
TEST(Resonance, OfOneHarmonicIsThatOfAnOscillator) {
  const auto stress = tension(0, {{3, 5e6}});
  const double peak = stress.row(2).abs().maxCoeff();  // the cosine is not sampled at its peak
  for (const double f1 : {31.0, 60.0, 300.0, 1e4}) {
    const auto d = dynamic_amplification(stress, turns, turn_Hz, 0, {{f1}});
    EXPECT_NEAR(d.factor, 1 + 5e6 / peak * std::abs(1 / std::abs(1 - std::pow(30 / f1, 2)) - 1), 1e-9) << f1;
    EXPECT_NEAR(d.highest.order, 3, 1e-12);
    EXPECT_NEAR(d.highest.frequency_Hz, 30, 1e-12);
    EXPECT_NEAR(d.highest.share, 5e6 / peak, 1e-12);
  }
}

TEST(Resonance, OfSeveralHarmonicsAddsUpByTheirShares) {
  const auto stress = tension(4e6, {{1, 3e6}, {4, 1e6}});
  const double peak = stress.row(2).abs().maxCoeff(), f1 = 100;
  const auto d = dynamic_amplification(stress, turns, turn_Hz, 0, {{f1}});
  EXPECT_NEAR(d.factor, 1 + (3e6 * amplified(0.1) + 1e6 * amplified(0.4)) / peak, 1e-12);
  EXPECT_NEAR(d.highest.order, 4, 1e-12);
}

// A rotating tensor: sine and cosine parts in different components count together.
TEST(Resonance, CountsCosineAndSineTogether) {
  Eigen::ArrayXXd stress = Eigen::ArrayXXd::Zero(6, n);
  for (int i = 0; i < n; ++i) {
    stress(3, i) = std::cos(2 * M_PI * turns * i / n);
    stress(4, i) = std::sin(2 * M_PI * turns * i / n);
  }
  const auto d = dynamic_amplification(stress, turns, turn_Hz, 0, {{50}});
  EXPECT_NEAR(d.highest.share, std::sqrt(2), 1e-12) << "a bound: no instant has more than the peak";
  EXPECT_NEAR(d.factor, 1 + std::sqrt(2) * amplified(0.2), 1e-12);
}

// In axes that turn, what stands still in them shakes once per turn.
TEST(Resonance, InTurningAxesEveryFrequencyIsHigherByTheSpin) {
  const auto d = dynamic_amplification(tension(2e6, {{1, 1e6}}), turns, turn_Hz, 10, {{100}});
  const double peak = tension(2e6, {{1, 1e6}}).row(2).abs().maxCoeff();
  EXPECT_NEAR(d.factor, 1 + (2e6 * amplified(0.1) + 1e6 * amplified(0.2)) / peak, 1e-12);
  EXPECT_NEAR(d.highest.frequency_Hz, 20, 1e-12);
}

// What oscillates across axes that turn is, at rest, a force that runs forward at f + spin and one that runs
// backward at f - spin. Here the latter meets the natural frequency; the former would have a third of its
// stress.
TEST(Resonance, InTurningAxesTheLowerFrequencyMayMeetIt) {
  const auto stress = tension(0, {{3, 1e6}});
  const auto d = dynamic_amplification(stress, turns, turn_Hz, 10, {{20}});
  EXPECT_NEAR(d.factor, 1 + 1e6 / stress.row(2).abs().maxCoeff() * (pipelines::resonance_peak - 1), 1e-9);
  EXPECT_NEAR(d.highest.frequency_Hz, 20, 1e-12);
  EXPECT_NEAR(d.highest_Hz, 40, 1e-12);
}

// A torque is the same in axes that turn and at rest: at 30 Hz it meets the natural frequency there, and a
// force does at 20 and 40 Hz. A load that stands still shakes nothing as a torque.
TEST(Resonance, OfATorqueIsAtItsOwnFrequency) {
  Eigen::ArrayXXd factors(2, n);
  for (int i = 0; i < n; ++i) {
    factors(0, i) = std::cos(2 * M_PI * turns * 3 * i / n);
    factors(1, i) = 1;
  }
  const double peak = 2;
  pipelines::UnitStress unit = pipelines::UnitStress::Zero(6, 2);
  unit.row(2).setConstant(1);
  const auto at = [&](bool across, double natural_Hz) {
    return pipelines::LoadLines(factors, {across, false}, turns, turn_Hz, {10})
        .amplification(unit, peak, {{natural_Hz}})
        .factor;
  };
  const double most = 1 + 0.5 * (pipelines::resonance_peak - 1);
  EXPECT_NEAR(at(false, 30), most, 1e-9);
  for (const double natural_Hz : {20, 40}) EXPECT_NEAR(at(true, natural_Hz), most, 1e-9);
  EXPECT_NEAR(at(true, 30), 1 + 0.5 * std::max(amplified(2. / 3), std::abs(1 / (16. / 9 - 1) - 1)), 1e-9);
}

TEST(Resonance, OfAConstantStressInAxesAtRestIsNone) {
  EXPECT_EQ(dynamic_amplification(tension(2e6, {}), turns, turn_Hz, 0, {{100}}).factor, 1);
}

TEST(Resonance, OfNoStressIsNone) {
  const auto d = dynamic_amplification(tension(0, {}), turns, turn_Hz, 10, {{100}});
  EXPECT_EQ(d.factor, 1);
  EXPECT_EQ(d.highest.share, 0);
}

TEST(Resonance, MetExactlyIsLimitedByDamping) {
  const auto stress = tension(0, {{3, 1e6}});
  EXPECT_NEAR(dynamic_amplification(stress, turns, turn_Hz, 0, {{30}}).factor,
              1 + 1e6 / stress.row(2).abs().maxCoeff() * (pipelines::resonance_peak - 1), 1e-9);
  // Rounding's share of that harmonic is none.
  EXPECT_NEAR(dynamic_amplification(tension(1e6, {{1, 1e3}}), turns, turn_Hz, 0, {{30}}).factor, 1, 2e-4);
}

TEST(Resonance, DoesNotDependOnTheSizeOfStress) {
  const auto stress = tension(4e6, {{1, 3e6}, {4, 1e6}});
  const double usual = dynamic_amplification(stress, turns, turn_Hz, 0, {{100}}).factor;
  for (const double size : {std::ldexp(1.0, -600), std::ldexp(1.0, 600)})
    EXPECT_EQ(dynamic_amplification(stress * size, turns, turn_Hz, 0, {{100}}).factor, usual);
}

TEST(Resonance, NeedsAFrequency) {
  EXPECT_THROW(dynamic_amplification(tension(1, {}), turns, turn_Hz, 0, {{0}}), std::invalid_argument);
  EXPECT_THROW(dynamic_amplification(tension(1, {}), turns, turn_Hz, 0, {{40, -1}}), std::invalid_argument);
}

// A mesh has frequencies too high. At 30 Hz below them the lower bound counts; between both bounds the load
// may meet the true one; beside both the nearer one; far above both, where stress falls, the one that leaves
// least.
TEST(Resonance, CountsAllThatAFrequencyMayBe) {
  const auto stress = tension(0, {{3, 1e6}});
  const double weight = 1e6 / stress.row(2).abs().maxCoeff();
  const auto added = [&](double value_Hz, double error_Hz) {
    return (dynamic_amplification(stress, turns, turn_Hz, 0, {{value_Hz, error_Hz}}).factor - 1) / weight;
  };
  EXPECT_NEAR(added(60, 20), amplified(30. / 40), 1e-9);
  EXPECT_NEAR(added(32, 2.5), pipelines::resonance_peak - 1, 1e-9);
  EXPECT_NEAR(added(28, 4), amplified(30. / 28), 1e-9);
  EXPECT_NEAR(added(15, 5), -amplified(30. / 10), 1e-9);
  EXPECT_NEAR(added(31, 62), pipelines::resonance_peak - 1, 1e-9) << "the mesh tells nothing";
  EXPECT_NEAR(added(20, 20), 1, 1e-9) << "not below zero, where nothing of the stress is left";
  EXPECT_EQ(dynamic_amplification(tension(2e6, {}), turns, turn_Hz, 0, {{100, 100}}).factor, 1);
}

// A harmonic beside the second frequency is not helped by being far above the first: 1 / |1 - (99 / 100)^2|
// = 50.25, of which damping leaves 50. Far from both it is that of the nearer one.
TEST(Resonance, MeetsHigherFrequenciesToo) {
  const auto stress = tension(2e6, {{1, 1e6}});
  const auto d = dynamic_amplification(stress, turns, 99, 0, {{25}, {100}});
  EXPECT_NEAR(d.factor, 1 + 49e6 / stress.row(2).abs().maxCoeff(), 1e-9);
  EXPECT_EQ(d.highest.amplification, pipelines::resonance_peak);
  EXPECT_THROW(dynamic_amplification(tension(1, {}), turns, turn_Hz, 0, {}), std::invalid_argument);
}

}  // namespace
