/// Shares of the effects in damage against closed forms, and against whole judgements with one effect a
/// little larger and smaller. Turns red: shares of the amplitude instead, the mean left out, or its ends
/// held, the support by the gradient left out, or its ends held, one slope on both sides of the knee, starts
/// without their transient.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "pipelines/judge/life/duty_fatigue.h"
#include "pipelines/judge/life/duty_shares.h"
#include "tests/unit/pipelines/examples/row_of_cells.h"

namespace {

using namespace pipelines;
using Eigen::ArrayXXd;
using Eigen::Index;

constexpr double fkm_slope = 5;  // steel; below the knee too, once something is above it
constexpr Index n_at = 96;
constexpr LoadPeriod one_second{1, 1};

/// Effects on channels with some orders each. Every node of a layer has the same stress.
struct Body {
  Judged analysis;

  /// @param depth_share by channel: how much less it stresses a node 1 mm below the surface, x = 0
  Body(const UnitStresses& unit_Pa, const std::vector<ArrayXXd>& by_effect,
       const std::vector<double>& depth_share) {
    examples::Row row(3);
    for (auto& x : row.nodes.xyz_m) x *= 1e-3;
    analysis.method = depth_share.empty() ? Method::beam : Method::solid;
    analysis.mesh.features = row.features;
    for (auto& feature : analysis.mesh.features) feature.begin_m *= 1e-3, feature.end_m *= 1e-3;
    analysis.places = row.places();
    analysis.responses.nodes = row.nodes;
    auto& fatigue = analysis.scene.fatigue.emplace();
    fatigue.material.tensile_strength_Pa = 600e6;
    fatigue.material.yield_strength_Pa = 300e6;
    fatigue.roughness_m = 1e-6;
    auto& history = analysis.loads.history;
    for (Index k = 0; k < unit_Pa.cols(); ++k) {
      analysis.responses.channels.push_back("c" + std::to_string(k));
      history.channels.push_back({analysis.responses.channels.back(), "N"});
    }
    for (std::size_t i = 0; i < row.nodes.n; ++i)
      for (Index k = 0; k < unit_Pa.cols(); ++k) {
        const double depth_mm = 1e3 * row.nodes.xyz_m[3 * i];
        const double left = depth_share.empty() ? 1 : 1 - depth_share[std::size_t(k)] * depth_mm;
        for (Index c = 0; c < 6; ++c) analysis.responses.stress_Pa.push_back(left * unit_Pa(c, k));
      }
    for (std::size_t e = 0; e < by_effect.size(); ++e) history.effects.push_back("e" + std::to_string(e));
    history.by_effect = by_effect;
    take_sum();
  }

  void take_sum() {
    auto& history = analysis.loads.history;
    history.values = history.by_effect.front();
    for (std::size_t e = 1; e < history.by_effect.size(); ++e) history.values += history.by_effect[e];
    analysis.envelope = envelope(history, analysis.responses, 1);
  }

  FatiguePlace judged() const { return judge_fatigue(analysis, one_second, 1).places.front(); }

  FatiguePlace with(std::size_t effect, double factor) const {
    Body other = *this;
    other.analysis.loads.history.by_effect[effect] *= factor;
    other.take_sum();
    return other.judged();
  }
};

double sum_of(const std::vector<double>& shares) {
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

/// size cos(2 pi order i / n + phase) on one channel of K, n instants.
ArrayXXd wave(Index n_channels, Index channel, double size, int order, double phase = 0, Index n = n_at) {
  ArrayXXd values = ArrayXXd::Zero(n_channels, n);
  for (Index i = 0; i < n; ++i)
    values(channel, i) = size * std::cos(2 * M_PI * double(order) * double(i) / double(n) + phase);
  return values;
}

UnitStresses tension() {
  UnitStresses unit = UnitStresses::Zero(6, 1);
  unit(2, 0) = 1;
  return unit;
}

// In proportion: shares are the parts of the load, whether the place is damaged or not.
TEST(DamageShares, OfProportionalEffectsAreTheirParts) {
  for (const double size : {1e6, 260e6}) {
    const Body body(tension(),
                    {wave(1, 0, 0.7 * size, 1), wave(1, 0, 0.5 * size, 1), wave(1, 0, -0.2 * size, 1)}, {});
    const auto place = body.judged();
    EXPECT_EQ(place.damage_per_turn > 0, size > 2e8);
    ASSERT_EQ(place.damage_share.size(), 3u);
    // Rounding of sums.
    EXPECT_NEAR(place.damage_share[0], 0.7, 1e-12);
    EXPECT_NEAR(place.damage_share[1], 0.5, 1e-12);
    EXPECT_NEAR(place.damage_share[2], -0.2, 1e-12);
  }
}

// A constant effect has no share of the amplitude, but of the damage: with FKM's M between R = -1 and 0,
// A = a + M m, and between 0 and 0.5 A = c (a + m M / 3).
TEST(DamageShares, OfAMeanAreByItsSensitivity) {
  const double m_of_steel = 0.35e-3 * 600 - 0.1;
  for (const double mean : {0.5, 2.0}) {
    const Body body(tension(), {wave(1, 0, 150e6, 1), wave(1, 0, mean * 150e6, 0)}, {});
    const auto place = body.judged();
    const double slope = mean < 1 ? m_of_steel : m_of_steel / 3;
    EXPECT_NEAR(place.effect_share[1], 0, 1e-12);
    EXPECT_NEAR(place.damage_share[1], slope * mean / (1 + slope * mean), 1e-9) << "to what crests are found";
  }
  // A compressive mean relieves.
  const Body body(tension(), {wave(1, 0, 250e6, 1), wave(1, 0, -125e6, 0)}, {});
  EXPECT_NEAR(body.judged().damage_share[1], -0.5 * m_of_steel / (1 - 0.5 * m_of_steel), 1e-9);
}

TEST(DamageShares, OfNothingAreEmpty) {
  const Body still(tension(), {wave(1, 0, 1e6, 0), wave(1, 0, 2e6, 0)}, {});
  EXPECT_TRUE(still.judged().damage_share.empty());
}

struct Random {
  std::mt19937 engine;
  std::normal_distribution<double> normal{};
  double operator()() { return normal(engine); }
};

/// Three channels, three effects: each is on two channels with an order each, and constant on one.
Body random_body(Random& random, bool with_gradients) {
  const UnitStresses unit = UnitStresses::NullaryExpr(6, 3, [&] { return random(); });
  std::array<int, 3> order{};
  for (auto& one : order) one = int(1 + std::min(6.0, std::floor(3 * std::abs(random()))));
  std::vector<ArrayXXd> by_effect;
  for (Index e = 0; e < 3; ++e) {
    by_effect.push_back(wave(3, (e + 1) % 3, 2e8 * random(), 0));
    for (Index part = 0; part < 2; ++part)
      by_effect.back() += wave(3, (e + part) % 3, 3e8 * random(), order[std::size_t(part)], 3 * random());
  }
  std::vector<double> depth;
  if (with_gradients)
    for (int k = 0; k < 3; ++k) depth.push_back(0.05 + 0.3 * std::abs(random()));
  Body body(unit, by_effect, depth);
  body.analysis.scene.fatigue->material.tensile_strength_Pa = 1200e6;  // M is 0.32: means count
  return body;
}

/// Differences of shares from those by finite differences: half of them, and 90 %, are below.
void expect_small(std::vector<double> off, double half, double ninety_percent) {
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() / 2], half);
  EXPECT_LT(off[off.size() * 9 / 10], ninety_percent);
}

// d ln(D) / ds_e is the slope times the share: against judgements of the whole body with the effect larger
// and smaller. The direction of counting is stationary and where it is held in them nothing else differs:
// what is left of a difference is step^2 times slope^2 and crests to 1e-6. Not so at few places whose
// direction of most damage lies where other turning points pair up: there damage jumps by up to some per
// cent, as equal ranges get other means, and the edge moves with the effects.
// Turns red: directions to 1/200 rad, as their search leaves them (shares off by 1e-4, and one in ten by
// 4e-3).
TEST(DamageShares, ArePredictionsOfWholeJudgements) {
  Random random{std::mt19937(11)};
  constexpr double step = 1e-3;
  for (const bool with_gradients : {false, true}) {
    std::vector<double> off;
    for (int trial = 0; trial < 16; ++trial) {
      const auto body = random_body(random, with_gradients);
      const auto place = body.judged();
      ASSERT_EQ(place.damage_share.size(), 3u);
      EXPECT_NEAR(sum_of(place.damage_share), 1, 1e-12);
      if (!(place.damage_per_turn > 0)) continue;
      for (std::size_t e = 0; e < 3; ++e) {
        const double larger = body.with(e, 1 + step).damage_per_turn,
                     smaller = body.with(e, 1 - step).damage_per_turn;
        off.push_back(std::abs(std::log(larger / smaller) / (2 * step) / fkm_slope - place.damage_share[e]));
      }
    }
    ASSERT_GT(off.size(), 40u);
    expect_small(off, 1e-6, 1e-5);
  }
}

/// Of a gradient and a strength [1/mm, MPa]: FKM's n_sigma of grey cast iron between 0.1 and 1 / mm.
double support_of_grey_iron(double gradient, double strength) {
  return 1 + std::sqrt(gradient) * std::pow(10, -(-0.05 + strength / 3200));
}

/// Two effects in tension, on channels of which one falls by 10 % in a millimetre below the surface, the
/// other by 45 %.
Body with_unlike_gradients(const ArrayXXd& flat, const ArrayXXd& steep) {
  UnitStresses unit = UnitStresses::Zero(6, 2);
  unit.row(2).setOnes();
  Body body(unit, {flat, steep}, {0.1, 0.45});
  auto& material = body.analysis.scene.fatigue->material;
  material.group = MaterialGroup::grey_cast_iron;
  material.tensile_strength_Pa = 400e6;
  material.yield_strength_Pa = 300e6;
  return body;
}

// In proportion, by hand: D ~ (A / n(G))^k with A = sum of a_e and A G = sum of a_e G_e, so that
//   share_e = a_e / A (1 - (G_e / G - 1) d ln(n) / d ln(G)),  d ln(n) / d ln(G) = (n - 1) / (2 n).
// Turns red: support left out, with the other sign, or twice: shares move by 0.05.
TEST(DamageShares, KnowTheSupportByTheGradient) {
  const double flat_Pa = 100e6, steep_Pa = 60e6;
  const auto place = with_unlike_gradients(wave(2, 0, flat_Pa, 1), wave(2, 1, steep_Pa, 1)).judged();
  ASSERT_GT(place.damage_per_turn, 0);
  const double part = flat_Pa / (flat_Pa + steep_Pa), gradient = 0.1 * part + 0.45 * (1 - part);
  const double n = support_of_grey_iron(gradient, 400), by_gradient = (n - 1) / (2 * n);
  EXPECT_NEAR(place.support, n, 1e-12) << "the field is linear: rounding";
  EXPECT_NEAR(place.damage_share[0], part * (1 - (0.1 / gradient - 1) * by_gradient), 1e-8)
      << "the support's slope is a difference with a step of 1e-4";
  EXPECT_GT(std::abs(place.damage_share[0] - part), 0.05) << "without support";
}

// Out of phase, the instants of the gradient move with the effects: against whole judgements with an effect
// 0.1 % larger and smaller. Turns red: instants held, shares are off by 0.002.
TEST(DamageShares, KnowTheSupportAtInstantsThatMove) {
  constexpr double step = 1e-3;
  const auto body = with_unlike_gradients(wave(2, 0, 100e6, 1) + wave(2, 0, 30e6, 3, 0.4),
                                          wave(2, 1, 80e6, 1, 1.2) + wave(2, 1, 20e6, 0));
  const auto place = body.judged();
  ASSERT_GT(place.damage_per_turn, 0);
  EXPECT_NEAR(sum_of(place.damage_share), 1, 1e-12);
  for (std::size_t e = 0; e < 2; ++e) {
    const double larger = body.with(e, 1 + step).damage_per_turn,
                 smaller = body.with(e, 1 - step).damage_per_turn;
    EXPECT_NEAR(place.damage_share[e], std::log(larger / smaller) / (2 * step) / fkm_slope, 1e-5)
        << "step^2 times the slope squared, and crests to 1e-6";
  }
}

// Where nothing damages the shares are those of the damage that begins: they do not depend on the size of all
// loads. In tension, where there is one direction to count along. Red if they are those of the largest cycle
// alone.
TEST(DamageShares, DoNotDependOnTheSizeOfAllLoads) {
  Random random{std::mt19937(5)};
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<ArrayXXd> by_effect;
    for (int e = 0; e < 3; ++e)
      by_effect.push_back(wave(1, 0, 3e8 * (1 + std::abs(random())), 1 + 2 * e, random()) +
                          wave(1, 0, 1e8 * random(), 0));
    const Body body(tension(), by_effect, {0.1});
    Body small = body;
    for (auto& part : small.analysis.loads.history.by_effect) part *= 1e-3;
    small.take_sum();
    const auto large_place = body.judged(), small_place = small.judged();
    ASSERT_GT(large_place.damage_per_turn, 0);
    ASSERT_EQ(small_place.damage_per_turn, 0);
    for (std::size_t e = 0; e < 3; ++e)
      EXPECT_NEAR(small_place.damage_share[e], large_place.damage_share[e], 1e-9) << trial << ": rounding";
  }
}

// A zone's peak is a node like any other: its damage is that of the place with the same stress, and its
// channels have shares too. Each channel alone is an effect here, so both are the same numbers.
TEST(DamageShares, OfZonesHaveChannels) {
  Random random{std::mt19937(7)};
  for (int trial = 0; trial < 5; ++trial) {
    const UnitStresses unit = UnitStresses::NullaryExpr(6, 3, [&] { return random(); });
    std::vector<ArrayXXd> by_effect;
    for (Index k = 0; k < 3; ++k)
      by_effect.push_back(wave(3, k, 2e8 * random(), 0) + wave(3, k, 2e8 * random(), int(k) + 1, random()));
    Body body(unit, by_effect, {0.05, 0.1, 0.15});
    Zone on_surface, inside;
    on_surface.peak_node = body.judged().node;
    inside.peak_node = 1;  // x is not zero there
    body.analysis.zones.zones = {on_surface, inside};
    const auto fatigue = judge_fatigue(body.analysis, one_second, 1);
    ASSERT_EQ(fatigue.zones.size(), 2u);
    EXPECT_FALSE(fatigue.zones[1].is_on_surface);
    EXPECT_TRUE(fatigue.zones[1].shares.effects.empty());
    const auto& zone = fatigue.zones[0];
    EXPECT_TRUE(zone.is_on_surface);
    EXPECT_NEAR(zone.damage_per_turn, fatigue.places[0].damage_per_turn,
                1e-6 * fatigue.places[0].damage_per_turn)
        << "at the same node";
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(zone.shares.channels[k], zone.shares.effects[k], 1e-9) << "crests are found to 1e-6";
  }
}

WeldPlace random_toe(Random& random, Index n_channels) {
  WeldPlace toe;
  toe.unit_Pa = UnitStresses::NullaryExpr(6, n_channels, [&] { return random(); });
  toe.surface_normal = {0, 0, 1};
  toe.across_toe = {1, 0, 0};
  toe.detail = {90e6, 0.006, WeldDetail().thickness_exponent, 1.35};
  return toe;
}

// Toes, with one order (slope 22 or 3) and with three (slopes 3 and 5 side by side). The governing direction
// has the largest damage by slope 3 and is searched to 1e-8 rad; where cycles below the knee count, its
// turning is left out: some thousandths.
TEST(DamageShares, OfToesPredictTheirDamage) {
  Random random{std::mt19937(3)};
  constexpr double step = 1e-4;
  for (const int n_orders : {1, 3}) {
    std::vector<double> off;
    for (int trial = 0; trial < 20; ++trial) {
      const auto toe = random_toe(random, 3);
      ChannelHistory loads;
      loads.effects = {"a", "b", "c"};
      for (Index e = 0; e < 3; ++e)
        loads.by_effect.push_back(wave(3, e, 4e7 * random(), 1 + int(e) % n_orders, random()) +
                                  wave(3, (e + 1) % 3, 3e7 * random(), 1 + int(e) % n_orders, random()));
      const auto amplitude = n_orders == 1 ? LoadAmplitude::constant : LoadAmplitude::variable;
      const auto damage = [&](const std::vector<double>& factor, std::vector<double>* shares = nullptr) {
        ChannelHistory scaled = loads;
        scaled.values = ArrayXXd::Zero(3, n_at);
        for (std::size_t e = 0; e < 3; ++e) scaled.values += scaled.by_effect[e] *= factor[e];
        const FactorCourse course(scaled.values, Eigen::ArrayXd::Ones(3), 48);
        const auto stress = toe.stress(course);
        if (shares != nullptr)
          *shares = shares_in_damage(toe, scaled, course, stress, weld_curve(toe.detail, amplitude));
        return weld_damage(toe.detail, amplitude, stress.cycles);
      };
      std::vector<double> shares, by_difference;
      ASSERT_GT(damage({1, 1, 1}, &shares), 0);
      for (std::size_t e = 0; e < 3; ++e) {
        std::vector<double> more(3, 1), less(3, 1);
        more[e] += step, less[e] -= step;
        by_difference.push_back(damage(more) - damage(less));
      }
      const double sum = sum_of(by_difference);
      for (std::size_t e = 0; e < 3; ++e) off.push_back(std::abs(by_difference[e] / sum - shares[e]));
    }
    expect_small(off, n_orders == 1 ? 3e-4 : 1e-4, n_orders == 1 ? 3e-3 : 2e-3);
  }
}

/// A block of the body's effects times factors, with or without a transient of n instants.
struct DutyExample {
  std::vector<ChannelHistory> running, starting;
  std::vector<Envelope> envelopes;
  std::vector<NodalCycles> cycles;

  double damage_per_s(const Judged& body, double starts_per_s, std::vector<double>* shares) {
    std::vector<BlockOnBody> blocks;
    envelopes.clear(), cycles.clear();
    for (const auto& loads : running) {
      envelopes.push_back(envelope(loads, body.responses, 1));
      cycles.push_back(nodal_cycles(loads, body.responses, envelopes.back().von_mises,
                                    surface_nodes(body.responses.nodes), 1));
    }
    for (std::size_t b = 0; b < running.size(); ++b) {
      blocks.push_back({&running[b], &envelopes[b].von_mises, &cycles[b], {1.0 + double(b), 1}, 0.5});
      blocks.back().starting = b == 0 ? &starting[0] : nullptr;  // the other starts at once
      blocks.back().starts_per_s = starts_per_s;
    }
    EXPECT_EQ(effects_of_blocks(blocks).size(), 3u);
    const auto places = judge_duty(body, blocks, 1);
    if (shares != nullptr) *shares = places.front().effect_share;
    return places.front().damage_per_s;
  }
};

void scale(ChannelHistory& loads, const std::string& effect, double factor) {
  loads.values.setZero();
  for (std::size_t e = 0; e < loads.effects.size(); ++e)
    loads.values += loads.effects[e] == effect ? (loads.by_effect[e] *= factor) : loads.by_effect[e];
}

// Two blocks, the second one without the third effect and in another order of them, starts through a
// transient and at once: against judgements with one effect larger and smaller everywhere. Transients at
// random have many turning points: with 0.1 % larger loads one place in ten meets others that pair up, and
// its damage jumps by up to 0.7 %; with 0.01 % none of these does.
TEST(DamageShares, OverBlocksPredictTheirDamage) {
  Random random{std::mt19937(29)};
  constexpr double step = 1e-4;
  std::vector<double> off;
  for (int trial = 0; trial < 12; ++trial) {
    const auto body = random_body(random, trial % 2 == 0);
    const auto& history = body.analysis.loads.history;
    DutyExample duty;
    duty.running = {history, history};
    auto& second = duty.running[1];
    second.effects = {history.effects[1], history.effects[0]};
    second.by_effect = {1.2 * history.by_effect[1], 0.8 * history.by_effect[0]};
    scale(second, "", 1);
    duty.starting = {history};
    for (std::size_t e = 0; e < 3; ++e)
      duty.starting[0].by_effect[e] =
          wave(3, Index(e), 2.5e8 * random(), 3, random(), 50) + wave(3, Index(e), 1e8 * random(), 1, 0, 50);
    duty.starting[0].values.resize(3, 50);
    scale(duty.starting[0], "", 1);
    const double starts_per_s = trial % 3 == 0 ? 0 : 0.3;
    std::vector<double> shares;
    if (!(duty.damage_per_s(body.analysis, starts_per_s, &shares) > 0)) continue;
    ASSERT_EQ(shares.size(), 3u);
    EXPECT_NEAR(sum_of(shares), 1, 1e-12);
    for (std::size_t e = 0; e < 3; ++e) {
      const auto with = [&](double factor) {
        DutyExample other = duty;
        for (auto* list : {&other.running, &other.starting})
          for (auto& loads : *list) scale(loads, history.effects[e], factor);
        return other.damage_per_s(body.analysis, starts_per_s, nullptr);
      };
      off.push_back(std::abs(std::log(with(1 + step) / with(1 - step)) / (2 * step) / fkm_slope - shares[e]));
    }
  }
  ASSERT_GT(off.size(), 20u);
  // Half: rounding of what the crests leave over the step. Ninety per cent: three of 24 directions of blocks
  // and starts lie at an edge where others pair up, of which the damage in a held direction knows nothing.
  expect_small(off, 2e-6, 5e-3);
}

}  // namespace
