#include "pipelines/judge/life/duty_fatigue.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "kinetics/series/load_spectrum.h"
#include "pipelines/base/common/parallel.h"
#include "pipelines/judge/analysis/weld_places.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/judge/life/damage_direction.h"
#include "pipelines/judge/life/duty_shares.h"
#include "pipelines/judge/life/fatigue_places.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/superpose/envelope/nodal_cycles.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

/// Slack of the search in series of many instants, as starts are.
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

/// dD/ds of a part of the damage, an entry for each effect of all blocks.
using DerivativeBy = std::function<Eigen::VectorXd(const SnCurve&)>;

/// What the cycles of a place come to, block by block.
struct CountedBlocks {
  struct Block {
    std::vector<StressBlock> running;            ///< cycles in a second of operation
    std::vector<StressBlock> starting;           ///< cycles of start sequences in a second of operation
    std::vector<StressBlock> running_in_starts;  ///< cycles of the running in start sequences
    double amplitude_Pa = 0, start_amplitude_Pa = 0;
    /// What the instants leave unresolved of these amplitudes.
    double unresolved_share = 0, unresolved_start_share = 0;
    /// Amplitude plus size of the mean of the largest cycles; weld toes: largest size of the stress.
    double largest_Pa = 0;
  };
  std::vector<Block> blocks;
  std::vector<DerivativeBy> derivatives;  ///< their sum is that of the damage

  double largest_Pa() const {
    double largest = 0;
    for (const auto& block : blocks) largest = std::max(largest, block.largest_Pa);
    return largest;
  }

  std::vector<StressBlock> all() const {
    std::vector<StressBlock> result;
    for (const auto& block : blocks) {
      append(result, block.running, 1);
      append(result, block.starting, 1);
    }
    return result;
  }
};

/// Damage of a block with all stresses times a factor.
BlockDamage damage_of(const CountedBlocks::Block& block, const SnCurve& curve, double factor = 1) {
  const auto of = [&](const std::vector<StressBlock>& cycles) {
    return miner_damage(curve, scaled(cycles, factor));
  };
  BlockDamage damage;
  damage.amplitude_Pa = block.amplitude_Pa;
  damage.start_amplitude_Pa = block.start_amplitude_Pa;
  damage.damage_per_s = of(block.running);
  damage.starts_per_s = std::max(0.0, of(block.starting) - of(block.running_in_starts));
  return damage;
}

/// What the instants leave unresolved, by the damage of blocks and starts; without damage the largest.
double sampling_share(const CountedBlocks& counted, const DutyPlace& place) {
  double most = 0, weighed = 0;
  for (std::size_t b = 0; b < counted.blocks.size(); ++b) {
    const auto& block = counted.blocks[b];
    most = std::max({most, block.unresolved_share, block.unresolved_start_share});
    weighed += block.unresolved_share * place.blocks[b].damage_per_s +
               block.unresolved_start_share * place.blocks[b].starts_per_s;
  }
  return place.damage_per_s > 0 ? weighed / place.damage_per_s : most;
}

/// S-N curve for cycles of all blocks.
using CurveOf = std::function<SnCurve(const std::vector<StressBlock>&)>;

/// Damage by block with one curve for all.
void take_damage(const CountedBlocks& counted, const CurveOf& curve_of, double damage_sum,
                 const FatigueScene& scene, DutyPlace& place) {
  const auto all = counted.all();
  const auto curve = curve_of(all);
  place.damage_per_s = 0;
  for (const auto& block : counted.blocks) {
    place.blocks.push_back(damage_of(block, curve));
    place.damage_per_s += place.blocks.back().sum_per_s();
  }
  if (place.damage_per_s > 0) place.life_s = damage_sum / place.damage_per_s;
  place.error_share += sampling_share(counted, place);
  if (scene.wanted_life_s) place.life_safety = life_safety(curve, all, *scene.wanted_life_s, damage_sum);
  place.certainty = certainty_of(
      place.error_share, beyond_curve(counted.largest_Pa(), scene.material.yield_strength_Pa, curve, all),
      [&](double factor) {
        const auto other = curve_of(scaled(all, factor));
        double per_s = 0;
        for (const auto& block : counted.blocks) per_s += damage_of(block, other, factor).sum_per_s();
        return per_s > 0 ? std::optional(damage_sum / per_s) : std::nullopt;
      });
}

std::vector<double> shares_by_effect(const CountedBlocks& counted, const SnCurve& curve, Index n_effects) {
  const auto of_shares = curve_with_damage(curve, counted.all());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_effects);
  for (const auto& derivative : counted.derivatives) sum += derivative(of_shares);
  return shares_of(sum);
}

/// Ranges as they are, as weld toes count them.
WeighedCycles weighed(const StressCourse& stress, const Eigen::Matrix<double, 6, 1>& form, double per_s) {
  WeighedCycles result{stress.cycles_of(form), {}};
  for (const auto& cycle : result.cycles) result.blocks.push_back({cycle.range_Pa, per_s});
  return result;
}

std::vector<StressBlock> in_a_second(std::vector<StressBlock> blocks, double per_s) {
  for (auto& block : blocks) block.count *= per_s;
  return blocks;
}

SlopesOf ranges_along(const Eigen::Matrix<double, 6, 1>& form) {
  return [form](const EndsOfCycle& cycle) { return slopes_of_range(cycle, form); };
}

SlopesOf equivalents_along(const Eigen::Matrix<double, 6, 1>& form, const EnduranceLimit& limit) {
  return [form, sensitivity = limit.mean_stress_sensitivity](const EndsOfCycle& cycle) {
    return slopes_of_equivalent(cycle, form, sensitivity);
  };
}

class DutyJudge {
public:
  DutyJudge(const Judged& analysis, const std::vector<BlockOnBody>& blocks)
      : analysis_(analysis),
        blocks_(blocks),
        shares_(effects_of_blocks(blocks)),
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
    for (const auto& places : places_)
      for (const auto& node : places.worst_of(nodes)) candidates.insert(node.node);
    for (const auto& block : blocks_)
      if (block.start_von_mises != nullptr)
        candidates.insert(*std::max_element(nodes.begin(), nodes.end(), [&](std::size_t a, std::size_t b) {
          return block.start_von_mises->value_Pa[a] < block.start_von_mises->value_Pa[b];
        }));
    candidates.insert(*std::max_element(nodes.begin(), nodes.end(), [&](std::size_t a, std::size_t b) {
      return damage_about_[a] < damage_about_[b];
    }));
    std::optional<DutyPlace> worst;
    std::size_t worst_node = 0;
    CountedBlocks counted;
    for (const auto node : candidates) {
      auto place = at(node, 0, Directions::about, counted);
      if (worst && !is_worse(place, *worst)) continue;
      worst = std::move(place);
      worst_node = node;
    }
    auto place = at(worst_node, error_share(feature, worst_node), Directions::stationary, counted);
    place.feature = feature;
    place.effect_share = shares_by_effect(counted, rules_.design_curve(counted.all()), shares_.n_effects());
    return place;
  }

  /// The largest of the amplitudes of all blocks and starts, without what the instants leave unresolved.
  double error_share(const std::string& feature, std::size_t node) const {
    double most = 0;
    const auto take = [&](const BodyLoads& half_change) {
      most = std::max(most, whole_error_share_of_change(analysis_, feature, node, half_change, 0));
    };
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const auto own = places_[b].at(node);
      take(places_[b].half_change_between(own.from, own.to));
      if (blocks_[b].starts_per_s > 0) take(half_change_of_start(node, b));
    }
    return most;
  }

  DutyPlace weld(const WeldPlace& weld) const {
    DutyPlace place;
    place.feature = weld.name;
    place.position_m = weld.toe_m;
    place.is_weld = true;
    place.error_share = weld.error_share;
    CountedBlocks counted;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const auto& block = blocks_[b];
      const auto& course = places_[b].course();
      auto& own = counted.blocks.emplace_back();
      const auto running = weld.stress(course);
      own.amplitude_Pa = take_ranges(running.cycles, block.running_per_s(), own.running);
      own.largest_Pa = running.stress_Pa.abs().maxCoeff();
      own.unresolved_share = weld.unresolved_share(course, running);
      counted.derivatives.push_back(
          [this, &weld, &block, &course, form = running.form](const SnCurve& curve) {
            const StressCourse stress(weld.unit_Pa, course);
            return shares_.running({weld.unit_Pa, block, course},
                                   weighed(stress, form, block.running_per_s()), ranges_along(form), curve);
          });
      if (!(block.starts_per_s > 0)) continue;
      const auto& starting = block.starting != nullptr ? block.starting->values : ArrayXXd();
      const auto start = weld.stress(start_sequence(course.fine(), starting));
      own.start_amplitude_Pa = take_ranges(start.cycles, block.starts_per_s, own.starting);
      own.largest_Pa = std::max(own.largest_Pa, start.stress_Pa.abs().maxCoeff());
      take_ranges(kinetics::rainflow_repeating(start.stress_Pa.tail(course.fine().cols())),
                  block.starts_per_s, own.running_in_starts);
      own.unresolved_start_share = start_sampling_share(weld.unit_Pa, starting, own.start_amplitude_Pa);
      counted.derivatives.push_back([this, &weld, &block, &course, form = start.form](const SnCurve& curve) {
        const ArrayXXd before = block.starting != nullptr ? block.starting->values : ArrayXXd();
        const auto under = [&](const ArrayXXd& factors) {
          return weighed(StressCourse((weld.unit_Pa * factors.matrix()).array()), form, block.starts_per_s);
        };
        return shares_.starting({weld.unit_Pa, block, course}, under(start_sequence(course.fine(), before)),
                                under(course.fine()), ranges_along(form), curve);
      });
    }
    const auto curve = weld_curve(weld.detail, LoadAmplitude::variable);
    take_damage(
        counted, [&](const auto&) { return curve; }, damage_sum_of_spectra, rules_.scene(), place);
    place.effect_share = shares_by_effect(counted, curve, shares_.n_effects());
    return place;
  }

  /// Orders places by damage; where there is none, by what is left until there would be.
  static bool is_worse(const DutyPlace& a, const DutyPlace& b) {
    const auto safety = [](const DutyPlace& place) {
      return place.life_safety.value_or(std::numeric_limits<double>::infinity());
    };
    if (a.damage_per_s != b.damage_per_s) return a.damage_per_s > b.damage_per_s;
    if (safety(a) != safety(b)) return safety(a) < safety(b);
    if (a.utilisation != b.utilisation) return a.utilisation > b.utilisation;
    return largest_amplitude_Pa(a) > largest_amplitude_Pa(b);
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
          std::pow(rules_.limit(0, scalar(cycles.cycles[i])).utilisation, rules_.group().slope);
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

  /// Share by which the amplitude of a start's largest cycle may be larger between its instants.
  static double start_sampling_share(const UnitStresses& unit_Pa, const ArrayXXd& starting,
                                     double amplitude_Pa) {
    if (starting.cols() == 0 || !(amplitude_Pa > 0)) return 0;
    std::vector<std::array<double, 6>> tensors(std::size_t(unit_Pa.cols()));
    for (Index k = 0; k < unit_Pa.cols(); ++k)
      std::copy_n(unit_Pa.col(k).data(), 6, tensors[std::size_t(k)].begin());
    return time_sampling(tensors, starting, SeriesKind::transient).error_Pa() / amplitude_Pa;
  }

  /// Half of the change of the loads over the largest cycle of a start, as loads of one instant.
  BodyLoads half_change_of_start(std::size_t node, std::size_t b) const {
    const ArrayXXd sequence =
        start_sequence(places_[b].course().fine(),
                       blocks_[b].starting != nullptr ? blocks_[b].starting->values : ArrayXXd());
    const UnitStresses unit = unit_stresses_at(analysis_.responses, node);
    const auto cycle = StressCourse((unit * sequence.matrix()).array()).largest(slack_of_long_series);
    BodyLoads change;
    change.unit_loads = analysis_.loads.unit_loads;
    change.history.values = 0.5 * (sequence.col(Index(cycle.to)) - sequence.col(Index(cycle.from)));
    return change;
  }

  static double amplitude_and_mean_Pa(const StressCycle& cycle) {
    return cycle.amplitude_Pa + std::abs(cycle.signed_mean_Pa);
  }

  /// Directions of counting: `about` as FatiguePlaces::counted, `stationary` as FatiguePlaces::stationary.
  /// The former compare places, by damage: what the instants leave unresolved is not sought.
  enum class Directions { about, stationary };

  DutyPlace at(std::size_t node, double error_share, Directions kind, CountedBlocks& counted) const {
    DutyPlace place;
    counted = {};
    place.error_share = error_share;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const auto own = places_[b].at(node);
      place.utilisation = std::max(place.utilisation, own.utilisation);
      auto& cycles = counted.blocks.emplace_back();
      count(own, places_[b], blocks_[b], kind, cycles, counted.derivatives);
      for (const auto& cycle : cycles.starting)
        place.utilisation = std::max(place.utilisation, cycle.amplitude_Pa * rules_.scene().safety);
    }
    std::copy_n(&analysis_.responses.nodes.xyz_m[3 * node], 3, place.position_m.begin());
    take_damage(
        counted, [&](const auto& cycles) { return rules_.design_curve(cycles); }, 1, rules_.scene(), place);
    return place;
  }

  void count(const FatigueNode& node, const FatiguePlaces& places, const BlockOnBody& block, Directions kind,
             CountedBlocks::Block& own, std::vector<DerivativeBy>& derivatives) const {
    own.amplitude_Pa = node.cycle.amplitude_Pa;
    own.largest_Pa = amplitude_and_mean_Pa(node.cycle);
    auto counted = places.counted(node, block.period.duration_s / block.share);
    if (kind == Directions::stationary) counted = places.stationary(node, counted);
    append(own.running, counted.blocks, block.running_per_s());
    if (kind == Directions::stationary) own.unresolved_share = places.unresolved_share(node, counted);
    if (!counted.blocks.empty())
      derivatives.push_back([this, &places, &block, node, counted](const SnCurve& curve) {
        const auto stress = places.stress_of(node.node);
        const auto form = form_along(counted.direction);
        const auto support = places.support_slopes(node.node, counted);
        return shares_.running(
            {unit_stresses_at(analysis_.responses, node.node), block, places.course()},
            {stress.cycles_along(counted.direction), in_a_second(counted.blocks, block.running_per_s())},
            equivalents_along(form, counted.limit), curve, support, stress.is_smooth() ? &form : nullptr);
      });
    if (block.starts_per_s > 0) count_start(node, counted, places, block, kind, own, derivatives);
  }

  /// Counts the cycles of a start along the direction in which it does most damage beyond that of the running
  /// in it, with the support that the running has.
  void count_start(const FatigueNode& node, const CountedNode& of_running, const FatiguePlaces& places,
                   const BlockOnBody& block, Directions kind, CountedBlocks::Block& own,
                   std::vector<DerivativeBy>& derivatives) const {
    const StressCourse running(places.stress_of(node.node).stress_Pa());
    const ArrayXXd starting = block.starting != nullptr
                                  ? stress_history_Pa(analysis_.responses, *block.starting, node.node)
                                  : ArrayXXd();
    const StressCourse sequence(start_sequence(running.stress_Pa(), starting));
    const auto cycle = sequence.largest(slack_of_long_series).cycle;
    if (!(cycle.amplitude_Pa > 0)) return;
    own.start_amplitude_Pa = cycle.amplitude_Pa;
    own.largest_Pa = std::max(own.largest_Pa, amplitude_and_mean_Pa(cycle));
    const auto limit = of_running.blocks.empty() ? rules_.limit(0, {}) : of_running.limit;
    const auto counted = [&](const StressCourse& course, const DeviatoricDirection& direction) {
      return rules_.counted(course.cycles_along(direction), limit);
    };
    const double slope = rules_.group().slope;
    const auto added = [&](const DeviatoricDirection& direction) {
      return elementary_damage(counted(sequence, direction), slope) -
             elementary_damage(counted(running, direction), slope);
    };
    const auto directions =
        damage_directions(sequence.coordinates(), direction_of(cycle.half_range_Pa), added);
    DeviatoricDirection worst = directions.front();
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& direction : directions)
      if (const double damage = added(direction); damage > most) {
        most = damage;
        worst = direction;
      }
    if (kind == Directions::stationary && most > 0) worst = stationary_direction(worst, added);
    WeighedCycles in_start{sequence.cycles_along(worst), {}}, in_running{running.cycles_along(worst), {}};
    for (auto* weighed : {&in_start, &in_running})
      weighed->blocks = in_a_second(rules_.counted(weighed->cycles, limit), block.starts_per_s);
    append(own.starting, in_start.blocks, 1);
    append(own.running_in_starts, in_running.blocks, 1);
    derivatives.push_back([=, &places, &block](const SnCurve& curve) {
      const auto support = places.support_slopes(node.node, of_running);
      return shares_.starting({unit_stresses_at(analysis_.responses, node.node), block, places.course()},
                              in_start, in_running, equivalents_along(form_along(worst), limit), curve,
                              support);
    });
    own.unresolved_start_share = block.starting == nullptr || kind == Directions::about
                                     ? 0
                                     : start_sampling_share(unit_stresses_at(analysis_.responses, node.node),
                                                            block.starting->values, cycle.amplitude_Pa);
  }

  const Judged& analysis_;
  const std::vector<BlockOnBody>& blocks_;
  DutyShares shares_;
  FatigueRules rules_;
  SurfaceSlopes slopes_;
  std::vector<FatiguePlaces> places_;  ///< by block
  std::vector<double> damage_about_;   ///< by node; see add_damage_about
};

}  // namespace

std::vector<DutyPlace> judge_duty(const Judged& analysis, const std::vector<BlockOnBody>& blocks,
                                  int n_threads) {
  const DutyJudge judge(analysis, blocks);
  const auto features = nodes_by_feature(analysis);
  std::vector<DutyPlace> result(features.size());
  const int at_once = threads_in_step(analysis.responses, n_threads);
  for_each_parallel(features.size(), at_once, [&](std::size_t, std::size_t i) {
    result[i] = judge.worst_of(features[i].first, features[i].second);
  });
  const auto welds = weld_places(analysis);
  const std::size_t n_features = features.size();
  result.resize(n_features + welds.size());
  for_each_parallel(welds.size(), at_once,
                    [&](std::size_t, std::size_t i) { result[n_features + i] = judge.weld(welds[i]); });
  std::stable_sort(result.begin(), result.end(), DutyJudge::is_worse);
  return result;
}

}  // namespace pipelines
