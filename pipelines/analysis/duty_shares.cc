#include "pipelines/analysis/duty_shares.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "pipelines/common/name_lists.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Hands over each cycle that matters with its weight.
/// @param sign  of the damage
/// @return the sum of the weights
template <typename Take>
double for_each_cycle(const WeighedCycles& weighed, const SnCurve& curve, double sign, const Take& take) {
  std::vector<double> weights;
  for (const auto& block : weighed.blocks) weights.push_back(damage_slope(curve, block));
  for (const auto i : cycles_that_matter(weights)) take(weighed.cycles[i], sign * weights[i]);
  return sign * std::accumulate(weights.begin(), weights.end(), 0.0);
}

}  // namespace

std::vector<std::string> effects_of_blocks(const std::vector<BlockOnBody>& blocks) {
  std::vector<std::string> effects;
  for (const auto& block : blocks)
    for (const auto* history : {block.running, block.starting}) {
      if (history == nullptr) continue;
      for (const auto& effect : history->effects)
        if (!contains(effects, effect)) effects.push_back(effect);
    }
  return effects;
}

/// By a history's own effects, at the entries of those of all blocks.
VectorXd DutyShares::on_all(const VectorXd& own, const std::vector<std::string>& names) const {
  VectorXd result = VectorXd::Zero(n_effects());
  for (std::size_t e = 0; e < names.size(); ++e)
    result[std::find(effects_.begin(), effects_.end(), names[e]) - effects_.begin()] += own[Index(e)];
  return result;
}

VectorXd DutyShares::running(const PlaceInBlock& at, const WeighedCycles& weighed, const SlopesOf& slopes_of,
                             const SnCurve& curve, const SupportSlopes* support,
                             const Eigen::Matrix<double, 6, 1>* moving) const {
  DamageDerivative derivative(at.unit_Pa, *at.block.running, &at.course);
  const double sum = for_each_cycle(weighed, curve, 1, [&](const EndsOfCycle& cycle, double weight) {
    derivative.add(cycle, slopes_of(cycle), weight, moving);
  });
  if (support != nullptr) derivative.add(*support, sum);
  return on_all(derivative.by_effect(), at.block.running->effects);
}

VectorXd DutyShares::starting(const PlaceInBlock& at, const WeighedCycles& start,
                              const WeighedCycles& its_running, const SlopesOf& slopes_of,
                              const SnCurve& curve, const SupportSlopes* support) const {
  if (!(miner_damage(curve, start.blocks) > miner_damage(curve, its_running.blocks)))
    return VectorXd::Zero(n_effects());
  const auto* transient = at.block.starting;
  const double n_before = transient != nullptr ? double(transient->values.cols()) : 1,
               per_step = double(at.course.per_step());
  DamageDerivative running(at.unit_Pa, *at.block.running, &at.course);
  std::optional<DamageDerivative> before;
  if (transient != nullptr) before.emplace(at.unit_Pa, *transient, nullptr);
  double sum = for_each_cycle(start, curve, 1, [&](const EndsOfCycle& cycle, double weight) {
    const auto slopes = slopes_of(cycle);
    const auto add_end = [&](double column, const Eigen::Matrix<double, 6, 1>& by_stress) {
      if (column >= n_before)
        running.add((column - n_before) / per_step, weight * by_stress);
      else if (before)
        before->add(column, weight * by_stress);
    };
    add_end(cycle.from_instant, slopes.by_from);
    add_end(cycle.to_instant, slopes.by_to);
  });
  sum += for_each_cycle(its_running, curve, -1, [&](const EndsOfCycle& cycle, double weight) {
    const auto slopes = slopes_of(cycle);
    running.add(cycle.from_instant / per_step, weight * slopes.by_from);
    running.add(cycle.to_instant / per_step, weight * slopes.by_to);
  });
  if (support != nullptr) running.add(*support, sum);
  VectorXd result = on_all(running.by_effect(), at.block.running->effects);
  if (before) result += on_all(before->by_effect(), transient->effects);
  return result;
}

}  // namespace pipelines
