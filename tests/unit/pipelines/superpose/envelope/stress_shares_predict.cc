/// Shares of effects and channels against closed forms, and against what becomes of the stress when an effect
/// is smaller or off.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "pipelines/superpose/envelope/stress_cycle.h"
#include "pipelines/superpose/envelope/stress_shares.h"

namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using pipelines::ChannelHistory;
using pipelines::Stress;
using pipelines::UnitStresses;

/// Channels and effects without values.
ChannelHistory named_loads(int n_channels, int n_effects, Index n_instants) {
  ChannelHistory loads;
  for (int k = 0; k < n_channels; ++k) loads.channels.push_back({"port.c" + std::to_string(k), "N"});
  for (int e = 0; e < n_effects; ++e) {
    loads.effects.push_back("effect " + std::to_string(e));
    loads.by_effect.push_back(ArrayXXd::Zero(n_channels, n_instants));
  }
  loads.values = ArrayXXd::Zero(n_channels, n_instants);
  return loads;
}

void add_up(ChannelHistory& loads) {
  loads.values.setZero();
  for (const auto& part : loads.by_effect) loads.values += part;
}

struct RandomPlace {
  UnitStresses unit_Pa;
  ChannelHistory loads = named_loads(7, 4, 37);
};

RandomPlace random_place(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto any = [&](double) { return normal(random); };
  RandomPlace place;
  place.unit_Pa = UnitStresses(6, 7).unaryExpr(any);
  for (auto& part : place.loads.by_effect) part = part.unaryExpr(any).eval();
  add_up(place.loads);
  return place;
}

Stress stress_of(const RandomPlace& place, const ArrayXXd& factors, Index instant) {
  Stress stress{};
  for (Index k = 0; k < factors.rows(); ++k)
    for (std::size_t c = 0; c < 6; ++c) stress[c] += place.unit_Pa(Index(c), k) * factors(k, instant);
  return stress;
}

ArrayXXd history_of(const RandomPlace& place) {
  return (place.unit_Pa * place.loads.values.matrix()).array();
}

/// The history with one effect times a factor.
RandomPlace with_effect_times(RandomPlace place, std::size_t effect, double factor) {
  place.loads.by_effect[effect] *= factor;
  add_up(place.loads);
  return place;
}

double sum(const std::vector<double>& shares) {
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

TEST(StressShares, AddUpToOne) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto place = random_place(seed);
    for (const auto& shares : {shares_of_stress(place.unit_Pa, place.loads, 5),
                               shares_of_change(place.unit_Pa, place.loads, 3, 17)}) {
      ASSERT_EQ(shares.effects.size(), 4u);
      ASSERT_EQ(shares.channels.size(), 7u);
      // Parts may be some ten times the whole and round accordingly.
      EXPECT_NEAR(sum(shares.effects), 1, 1e-12);
      EXPECT_NEAR(sum(shares.channels), 1, 1e-12);
    }
  }
}

// Bending and torsion at once: sigma_v^2 = sigma^2 + 3 tau^2, and the shares are its two terms. Of two
// effects on one channel they are the forces' own.
TEST(StressShares, OfBendingAndTorsion) {
  auto loads = named_loads(2, 3, 2);
  UnitStresses unit_Pa = UnitStresses::Zero(6, 2);
  unit_Pa(2, 0) = 10;  // zz per unit of the first channel
  unit_Pa(4, 1) = 2;   // yz per unit of the second
  loads.by_effect[0].row(0) << 9, -9;
  loads.by_effect[1].row(0) << -3, 3;
  loads.by_effect[2].row(1) << 10, 10;
  add_up(loads);
  const double sigma = 60, tau = 20, squared = sigma * sigma + 3 * tau * tau;
  const auto peak = shares_of_stress(unit_Pa, loads, 0);
  EXPECT_NEAR(peak.channels[0], sigma * sigma / squared, 1e-14);
  EXPECT_NEAR(peak.channels[1], 3 * tau * tau / squared, 1e-14);
  EXPECT_NEAR(peak.effects[0], 1.5 * sigma * sigma / squared, 1e-14);
  EXPECT_NEAR(peak.effects[1], -0.5 * sigma * sigma / squared, 1e-14) << "it relieves";
  EXPECT_NEAR(peak.effects[2], peak.channels[1], 1e-14);
  for (const auto& change :
       {shares_of_change(unit_Pa, loads, 0, 1), shares_of_change(unit_Pa, loads, 1, 0)}) {
    EXPECT_NEAR(change.effects[0], 1.5, 1e-14);
    EXPECT_NEAR(change.effects[1], -0.5, 1e-14);
    EXPECT_EQ(change.effects[2], 0) << "constant: none of the amplitude";
    EXPECT_NEAR(change.channels[0], 1, 1e-14);
  }
}

TEST(StressShares, OfTheSameStressAtBothInstantsAreZero) {
  const auto place = random_place(3);
  for (const double share : shares_of_change(place.unit_Pa, place.loads, 8, 8).effects) EXPECT_EQ(share, 0);
  for (const double share : shares_of_change(place.unit_Pa, place.loads, 8, 8).channels) EXPECT_EQ(share, 0);
}

TEST(StressShares, KeepTheirDigitsFromTheSmallestToTheLargestLoads) {
  const auto place = random_place(4);
  const auto one = shares_of_change(place.unit_Pa, place.loads, 2, 30);
  for (const int exponent : {-1000, -300, 300, 1000}) {
    auto other = place;
    for (auto& part : other.loads.by_effect) part *= std::ldexp(1.0, exponent);
    add_up(other.loads);
    const auto shares = shares_of_change(other.unit_Pa, other.loads, 2, 30);
    for (std::size_t e = 0; e < 4; ++e) EXPECT_NEAR(shares.effects[e], one.effects[e], 1e-14) << exponent;
    for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(shares.channels[k], one.channels[k], 1e-14) << exponent;
  }
}

// The envelope has the effects' shares of each node's peak by its own sum.
TEST(StressShares, OfAPeakAreThoseOfTheEnvelope) {
  auto place = random_place(5);
  fem::UnitResponses responses;
  responses.nodes.n = 2;
  for (const auto& channel : place.loads.channels) responses.channels.push_back(channel.name);
  responses.stress_Pa.assign(42, 0.25);
  responses.stress_Pa.insert(responses.stress_Pa.end(), place.unit_Pa.data(), place.unit_Pa.data() + 42);
  EXPECT_EQ(pipelines::unit_stresses_at(responses, 1), place.unit_Pa);
  const auto envelope = pipelines::envelope(place.loads, responses, 1);
  const auto shares =
      shares_of_stress(pipelines::unit_stresses_at(responses, 1), place.loads, envelope.von_mises.instant[1]);
  for (std::size_t e = 0; e < 4; ++e) EXPECT_FLOAT_EQ(float(shares.effects[e]), envelope.effect_share[4 + e]);
}

// Off, an effect takes its part of the tensor with it, exactly; its share is that part along the deviator.
TEST(StressShares, AnEffectThatIsOffTakesItsPartOfThePeak) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto place = random_place(seed);
    const Index instant = 11;
    const Stress whole = stress_of(place, place.loads.values, instant);
    const double sigma_v = pipelines::von_mises_Pa(whole);
    const auto shares = shares_of_stress(place.unit_Pa, place.loads, instant);
    for (std::size_t e = 0; e < 4; ++e) {
      const Stress without = stress_of(place, with_effect_times(place, e, 0).loads.values, instant);
      const auto tensor = [](const Stress& s) {
        return (Eigen::Matrix3d() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished();
      };
      const Eigen::Matrix3d all = tensor(whole), gone = all - tensor(without);
      const Eigen::Matrix3d deviator = all - all.trace() / 3 * Eigen::Matrix3d::Identity();
      const double wanted = 1.5 * gone.cwiseProduct(deviator).sum() / (sigma_v * sigma_v);
      EXPECT_NEAR(shares.effects[e], wanted, 1e-12);
      const Stress part = stress_of(place, place.loads.by_effect[e], instant);
      for (std::size_t c = 0; c < 6; ++c)
        EXPECT_NEAR(whole[c] - without[c], part[c], 1e-13 * sigma_v + 1e-13);
    }
  }
}

// The derivative of the amplitude's logarithm by the effect's size, from both sides: the second order cancels
// and leaves h^2 times shares of order ten, 1e-7. That of damage by a slope of 5 is five times as much.
TEST(StressShares, ChangeOfTheAmplitudeToFirstOrder) {
  constexpr double h = 1e-4, slope = 5;
  double largest = 0;
  int n_compared = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto place = random_place(seed);
    const auto cycle = pipelines::largest_cycle(history_of(place));
    const auto shares = shares_of_change(place.unit_Pa, place.loads, cycle.from, cycle.to);
    for (std::size_t e = 0; e < 4; ++e) {
      const auto smaller = pipelines::largest_cycle(history_of(with_effect_times(place, e, 1 - h)));
      const auto larger = pipelines::largest_cycle(history_of(with_effect_times(place, e, 1 + h)));
      if (smaller.from != cycle.from || larger.from != cycle.from || smaller.to != cycle.to ||
          larger.to != cycle.to)
        continue;  // a tie to within h has no derivative
      const double derivative = (larger.amplitude_Pa - smaller.amplitude_Pa) / (2 * h * cycle.amplitude_Pa);
      EXPECT_NEAR(derivative, shares.effects[e], 1e-6) << seed;
      const double of_damage = (std::pow(larger.amplitude_Pa / cycle.amplitude_Pa, slope) -
                                std::pow(smaller.amplitude_Pa / cycle.amplitude_Pa, slope)) /
                               (2 * h);
      EXPECT_NEAR(of_damage, slope * shares.effects[e], 1e-5) << seed;
      largest = std::max(largest, std::abs(shares.effects[e]));
      ++n_compared;
    }
  }
  EXPECT_GE(n_compared, 70) << "of eighty";
  EXPECT_GT(largest, 0.5) << "and not of nothing";
}

}  // namespace
