/// Damage over operating blocks against a sum by hand at every node: the places that are shown are the worst
/// ones, also where blocks peak at different nodes. Turns red: a block that brings no candidates, shares that
/// are not divided by periods, one S-N curve for each block.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "pipelines/judge/life/duty_fatigue.h"
#include "pipelines/judge/life/fatigue_places.h"
#include "tests/unit/pipelines/examples/row_of_cells.h"

namespace {

using namespace pipelines;

constexpr std::size_t n_channels = 3, n_blocks = 3;
constexpr Eigen::Index n_instants = 24;
/// FKM by hand: steel of 600 MPa, polished, reversed, safety 1.5; no support by the gradient.
constexpr double limit_Pa = 0.45 * 600e6 / 1.5, slope = 5, knee_cycles = 1e6;

struct Block {
  ChannelHistory loads;
  NodalMaximum von_mises;
  NodalCycles cycles;
  std::array<double, n_channels> amplitude{};
  double share = 0, period_s = 0;
};

struct Example {
  Judged body;
  std::vector<Block> blocks;

  explicit Example(std::mt19937& random) {
    std::uniform_real_distribution<double> any(0, 1);
    const examples::Row row(12);
    body.method = Method::beam;  // without gradients
    body.mesh.features = row.features;
    body.places = row.places();
    body.responses.nodes = row.nodes;
    body.scene.fatigue.emplace();
    body.scene.fatigue->material.tensile_strength_Pa = 600e6;
    body.scene.fatigue->material.yield_strength_Pa = 300e6;
    body.scene.fatigue->roughness_m = 1e-6;
    // Each channel stresses one place most, more or less around it.
    std::array<double, n_channels> at{}, width{};
    std::array<Stress, n_channels> tensor{};
    for (std::size_t k = 0; k < n_channels; ++k) {
      body.responses.channels.push_back("c" + std::to_string(k));
      at[k] = 24 * any(random);
      width[k] = 1 + 8 * any(random);
      for (auto& component : tensor[k]) component = any(random) - 0.5;
    }
    for (std::size_t i = 0; i < row.nodes.n; ++i)
      for (std::size_t k = 0; k < n_channels; ++k) {
        const double away = (row.nodes.xyz_m[3 * i + 2] - at[k]) / width[k];
        for (const double component : tensor[k])
          body.responses.stress_Pa.push_back(component * std::exp(-away * away));
      }
    for (std::size_t b = 0; b < n_blocks; ++b) blocks.push_back(block(random, b));
  }

  std::vector<BlockOnBody> on_body() const {
    std::vector<BlockOnBody> result;
    for (const auto& block : blocks)
      result.push_back({&block.loads, &block.von_mises, &block.cycles, {block.period_s, 1}, block.share});
    return result;
  }

  /// All channels are in phase: one cycle a period, whose amplitude is the von Mises stress of the sum.
  double damage_per_s(std::size_t node) const {
    double damage = 0;
    for (const auto& block : blocks) {
      Stress sum{};
      for (std::size_t k = 0; k < n_channels; ++k)
        for (std::size_t c = 0; c < 6; ++c)
          sum[c] += block.amplitude[k] * body.responses.stress_Pa[(node * n_channels + k) * 6 + c];
      damage += block.share / block.period_s * std::pow(von_mises_Pa(sum) / limit_Pa, slope) / knee_cycles;
    }
    return damage;
  }

private:
  Block block(std::mt19937& random, std::size_t b) {
    std::uniform_real_distribution<double> any(0, 1);
    Block result;
    result.share = 1. / n_blocks;
    result.period_s = 0.01 + 0.1 * any(random);
    result.loads.effects = {"all"};
    result.loads.values.resize(Eigen::Index(n_channels), n_instants);
    for (std::size_t k = 0; k < n_channels; ++k) {
      result.loads.channels.push_back({body.responses.channels[k], "N"});
      result.amplitude[k] = (k == b ? 1e9 : 2e8 * any(random));
      for (Eigen::Index i = 0; i < n_instants; ++i)
        result.loads.values(Eigen::Index(k), i) =
            result.amplitude[k] * std::cos(2 * M_PI * double(i) / double(n_instants));
    }
    result.loads.by_effect = {result.loads.values};
    result.von_mises = envelope(result.loads, body.responses, 1).von_mises;
    result.cycles =
        nodal_cycles(result.loads, body.responses, result.von_mises, surface_nodes(body.responses.nodes), 1);
    return result;
  }
};

TEST(DamageOverBlocks, IsThatOfTheWorstNode) {
  std::mt19937 random(17);
  double least = 1;
  for (int trial = 0; trial < 300; ++trial) {
    const Example example(random);
    const auto places = judge_duty(example.body, example.on_body(), 1);
    double most = 0;
    for (const auto node : surface_nodes(example.body.responses.nodes))
      most = std::max(most, example.damage_per_s(node));
    ASSERT_GT(most, 0);
    // Where nothing is above the limit nothing is damaged; there the sum by hand, with one slope, is no
    // reference.
    double largest_Pa = 0;
    for (const auto& block : example.blocks)
      for (const auto& cycle : block.cycles.cycles) largest_Pa = std::max(largest_Pa, cycle.amplitude_Pa);
    if (largest_Pa < limit_Pa) continue;
    EXPECT_LE(places.front().damage_per_s, most * (1 + 1e-9)) << trial;
    least = std::min(least, places.front().damage_per_s / most);
  }
  EXPECT_GT(least, 1 - 1e-9) << "of the worst node's damage";
}

// One block that changes nothing is the scene's own running: the same life safety at every place, also where
// nothing is damaged and nodes have unlike means. Turns red: ties between nodes broken by amplitude.
TEST(DamageOverBlocks, OfOneBlockIsThatOfTheScene) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> any(0, 1);
  for (int trial = 0; trial < 60; ++trial) {
    Example example(random);
    auto& block = example.blocks[0];
    const double scale = trial % 2 == 0 ? 0.05 : 1;  // far below the limit, and above it
    for (std::size_t k = 0; k < n_channels; ++k)
      block.loads.values.row(Eigen::Index(k)) =
          scale * (block.loads.values.row(Eigen::Index(k)) + 1e9 * (any(random) - 0.3));
    block.loads.by_effect = {block.loads.values};
    auto& body = example.body;
    body.scene.fatigue->wanted_life_s = 1e8;
    body.loads.history = block.loads;
    body.envelope = envelope(block.loads, body.responses, 1);
    block.von_mises = body.envelope.von_mises;
    block.cycles =
        nodal_cycles(block.loads, body.responses, block.von_mises, surface_nodes(body.responses.nodes), 1);
    const LoadPeriod period{block.period_s, 1};
    const auto alone = judge_fatigue(body, period, 1);
    const auto duty = judge_duty(body, {{&block.loads, &block.von_mises, &block.cycles, period, 1.0}}, 1);
    ASSERT_EQ(alone.places.size(), duty.size());
    for (const auto& place : alone.places) {
      const auto same = std::find_if(duty.begin(), duty.end(),
                                     [&](const auto& other) { return other.feature == place.feature; });
      ASSERT_NE(same, duty.end());
      // Duty may look at one node more, never at one less.
      EXPECT_LE(*same->life_safety, *place.life_safety * (1 + 1e-12)) << trial << ", " << place.feature;
      EXPECT_GE(*same->life_safety, *place.life_safety * (1 - 0.02)) << trial << ", " << place.feature;
    }
  }
}

// One block alternates, the other is steady and only starts: where all endures, places are ranked by what
// uses their limit most, a start's largest cycle among it. Turns red: the ranking knows running alone.
TEST(DamageOverBlocks, StartsRankPlacesThatEndure) {
  std::mt19937 random(29);
  for (int trial = 0; trial < 60; ++trial) {
    Example example(random);
    auto& body = example.body;
    auto& material = body.scene.fatigue->material;
    material.tensile_strength_Pa = 250e6;  // without sensitivity to mean stress
    material.yield_strength_Pa = 200e6;
    for (std::size_t b = 0; b < 2; ++b) {
      auto& block = example.blocks[b];
      block.loads.values *= b == 0 ? 0.01 : 0.03;
      if (b == 1) block.loads.values.colwise() = Eigen::ArrayXd(block.loads.values.col(0));
      block.loads.by_effect = {block.loads.values};
      block.von_mises = envelope(block.loads, body.responses, 1).von_mises;
      block.cycles =
          nodal_cycles(block.loads, body.responses, block.von_mises, surface_nodes(body.responses.nodes), 1);
    }
    auto blocks = example.on_body();
    blocks.resize(2);
    blocks[1].starts_per_s = 1e-3;
    blocks[1].start_von_mises = &example.blocks[1].von_mises;
    const auto places = judge_duty(body, blocks, 1);
    double above = 1;
    for (const auto& place : places) {
      double largest_Pa = 0;
      for (const auto& [feature, nodes] : nodes_by_feature(body))
        for (const auto node : nodes)
          if (feature == place.feature)
            largest_Pa = std::max({largest_Pa, example.blocks[0].von_mises.value_Pa[node],
                                   example.blocks[1].von_mises.value_Pa[node] / 2});
      EXPECT_EQ(place.damage_per_s, 0) << trial;
      EXPECT_NEAR(place.utilisation, largest_Pa / (0.45 * 250e6 / 1.5), 1e-9) << trial << place.feature;
      EXPECT_LE(place.utilisation, above) << trial << place.feature;
      above = place.utilisation;
    }
  }
}

}  // namespace
