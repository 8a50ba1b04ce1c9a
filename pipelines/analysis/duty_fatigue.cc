#include "pipelines/analysis/duty_fatigue.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "pipelines/analysis/fatigue_places.h"
#include "pipelines/analysis/weld_places.h"
#include "pipelines/common/parallel.h"
#include "pipelines/superposition/nodal_cycles.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

/// Starts have many instants.
constexpr double slack_of_long_series = 1e-6;

/// One repetition of a start: its transient, or rest, and then a period of running.
/// @param running, starting  a column per instant; starting may be empty
ArrayXXd start_sequence(const ArrayXXd& running, const ArrayXXd& starting) {
  const ArrayXXd before = starting.cols() > 0 ? starting : ArrayXXd::Zero(running.rows(), 1);
  ArrayXXd sequence(running.rows(), before.cols() + running.cols());
  sequence << before, running;
  return sequence;
}

/// Cycles that repeat so often in a second of operation.
void append(std::vector<StressBlock>& all, const std::vector<StressBlock>& counted, double per_s) {
  for (const auto& block : counted) all.push_back({block.amplitude_Pa, block.count * per_s});
}

/// What the cycles of a place come to, block by block.
struct CountedBlocks {
  struct Block {
    std::vector<StressBlock> running;            ///< in a second of operation
    std::vector<StressBlock> starting;           ///< of start sequences, likewise
    std::vector<StressBlock> running_in_starts;  ///< of the running in these
    double amplitude_Pa = 0, start_amplitude_Pa = 0;
  };
  std::vector<Block> blocks;

  std::vector<StressBlock> all() const {
    std::vector<StressBlock> result;
    for (const auto& block : blocks) {
      append(result, block.running, 1);
      append(result, block.starting, 1);
    }
    return result;
  }
};

/// Damage by block with one curve for all.
void take_damage(const CountedBlocks& counted, const SnCurve& curve, double damage_sum,
                 std::optional<double> wanted_life_s, DutyPlace& place) {
  place.damage_per_s = 0;
  for (const auto& block : counted.blocks) {
    BlockDamage damage;
    damage.amplitude_Pa = block.amplitude_Pa;
    damage.start_amplitude_Pa = block.start_amplitude_Pa;
    damage.damage_per_s = miner_damage(curve, block.running);
    damage.starts_per_s =
        std::max(0.0, miner_damage(curve, block.starting) - miner_damage(curve, block.running_in_starts));
    place.damage_per_s += damage.sum_per_s();
    place.blocks.push_back(damage);
  }
  if (place.damage_per_s > 0) place.life_s = damage_sum / place.damage_per_s;
  if (wanted_life_s) place.life_safety = life_factor(curve, counted.all(), *wanted_life_s, damage_sum);
}

class DutyJudge {
public:
  DutyJudge(const BodyAnalysis& analysis, const std::vector<BlockOnBody>& blocks)
      : analysis_(analysis),
        blocks_(blocks),
        rules_(*analysis.scene.fatigue),
        slopes_(analysis.responses.nodes) {
    damage_about_.assign(analysis.responses.nodes.n, 0);
    for (const auto& block : blocks) {
      places_.emplace_back(analysis, slopes_, *block.running, block.von_mises->value_Pa, rules_);
      add_damage_about(block);
    }
  }

  DutyPlace worst_of(const std::string& feature, const std::vector<std::size_t>& nodes) const {
    std::set<std::size_t> candidates;
    for (const auto& places : places_) candidates.insert(places.worst_of(nodes).node);
    for (const auto& block : blocks_)
      if (block.start_von_mises != nullptr)
        candidates.insert(*std::max_element(nodes.begin(), nodes.end(), [&](std::size_t a, std::size_t b) {
          return block.start_von_mises->value_Pa[a] < block.start_von_mises->value_Pa[b];
        }));
    candidates.insert(*std::max_element(nodes.begin(), nodes.end(), [&](std::size_t a, std::size_t b) {
      return damage_about_[a] < damage_about_[b];
    }));
    std::optional<DutyPlace> worst;
    for (const auto node : candidates) {
      auto place = at(node);
      const bool is_worse = !worst || place.damage_per_s > worst->damage_per_s ||
                            (place.damage_per_s == worst->damage_per_s &&
                             largest_amplitude_Pa(place) > largest_amplitude_Pa(*worst));
      if (is_worse) worst = std::move(place);
    }
    worst->feature = feature;
    worst->error_share = error_share_of(analysis_, feature);
    return std::move(*worst);
  }

  DutyPlace weld(const WeldPlace& weld) const {
    DutyPlace place;
    place.feature = weld.name;
    place.position_m = weld.toe_m;
    place.is_weld = true;
    place.error_share = weld.error_share;
    CountedBlocks counted;
    for (const auto& block : blocks_) {
      auto& own = counted.blocks.emplace_back();
      own.amplitude_Pa = take_ranges(weld.stress(block.running->values).cycles,
                                     block.share / block.period.duration_s, own.running);
      if (!(block.starts_per_s > 0)) continue;
      const auto& starting = block.starting != nullptr ? block.starting->values : ArrayXXd();
      own.start_amplitude_Pa =
          take_ranges(weld.stress(start_sequence(block.running->values, starting)).cycles, block.starts_per_s,
                      own.starting);
      take_ranges(weld.stress(block.running->values).cycles, block.starts_per_s, own.running_in_starts);
    }
    take_damage(counted, weld_curve(weld.detail, LoadAmplitude::variable), damage_sum_of_spectra,
                rules_.scene().wanted_life_s, place);
    return place;
  }

  static double largest_amplitude_Pa(const DutyPlace& place) {
    double largest = 0;
    for (const auto& block : place.blocks)
      largest = std::max({largest, block.amplitude_Pa, block.start_amplitude_Pa});
    return largest;
  }

private:
  /// One cycle a period, the same slope everywhere: in proportion to damage where nodes are alike.
  void add_damage_about(const BlockOnBody& block) {
    const auto& cycles = *block.cycles;
    for (std::size_t i = 0; i < cycles.nodes.size(); ++i)
      damage_about_[cycles.nodes[i]] +=
          block.share / block.period.duration_s *
          std::pow(rules_.limit(0, scalar(cycles.cycles[i])).utilisation, rules_.group().slope_normal);
  }

  /// @return half of the largest range
  static double take_ranges(const std::vector<kinetics::LoadCycle>& cycles, double per_s,
                            std::vector<StressBlock>& blocks) {
    double largest = 0;
    for (const auto& cycle : cycles) {
      blocks.push_back({cycle.range, cycle.count * per_s});
      largest = std::max(largest, cycle.range);
    }
    return largest / 2;
  }

  DutyPlace at(std::size_t node) const {
    CountedBlocks counted;
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      count(places_[b].at(node), blocks_[b], counted.blocks.emplace_back());
    DutyPlace place;
    std::copy_n(&analysis_.responses.nodes.xyz_m[3 * node], 3, place.position_m.begin());
    take_damage(counted, rules_.design_curve(counted.all()), 1, rules_.scene().wanted_life_s, place);
    return place;
  }

  void count(const FatigueNode& node, const BlockOnBody& block, CountedBlocks::Block& own) const {
    const ArrayXXd running = stress_history_Pa(analysis_.responses, *block.running, node.node);
    own.amplitude_Pa = node.cycle.amplitude_Pa;
    if (node.cycle.amplitude_Pa > 0)
      append(own.running,
             rules_.counted(along_cycle_Pa(running, node.cycle), node.cycle,
                            rules_.limit(node.gradient_per_m, scalar(node.cycle))),
             block.share / block.period.duration_s);
    if (!(block.starts_per_s > 0)) return;
    const ArrayXXd starting = block.starting != nullptr
                                  ? stress_history_Pa(analysis_.responses, *block.starting, node.node)
                                  : ArrayXXd();
    const ArrayXXd sequence = start_sequence(running, starting);
    const auto cycle = largest_cycle(sequence, slack_of_long_series);
    if (!(cycle.amplitude_Pa > 0)) return;
    own.start_amplitude_Pa = cycle.amplitude_Pa;
    const auto limit = rules_.limit(node.gradient_per_m, scalar(cycle));
    append(own.starting, rules_.counted(along_cycle_Pa(sequence, cycle), cycle, limit), block.starts_per_s);
    const Eigen::ArrayXd along = along_cycle_Pa(sequence, cycle).tail(running.cols());
    append(own.running_in_starts, rules_.counted(along, cycle, limit), block.starts_per_s);
  }

  const BodyAnalysis& analysis_;
  const std::vector<BlockOnBody>& blocks_;
  FatigueRules rules_;
  SurfaceSlopes slopes_;
  std::vector<FatiguePlaces> places_;  ///< by block
  std::vector<double> damage_about_;   ///< by node; see add_damage_about
};

}  // namespace

std::vector<DutyPlace> judge_duty(const BodyAnalysis& analysis, const std::vector<BlockOnBody>& blocks,
                                  int n_threads) {
  const DutyJudge judge(analysis, blocks);
  const auto features = nodes_by_feature(analysis);
  std::vector<DutyPlace> result(features.size());
  for_each_parallel(features.size(), n_threads, [&](std::size_t, std::size_t i) {
    result[i] = judge.worst_of(features[i].first, features[i].second);
  });
  for (const auto& weld : weld_places(analysis)) result.push_back(judge.weld(weld));
  std::stable_sort(result.begin(), result.end(), [](const DutyPlace& a, const DutyPlace& b) {
    return a.damage_per_s != b.damage_per_s
               ? a.damage_per_s > b.damage_per_s
               : DutyJudge::largest_amplitude_Pa(a) > DutyJudge::largest_amplitude_Pa(b);
  });
  return result;
}

}  // namespace pipelines
