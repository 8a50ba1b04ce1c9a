#include "pipelines/judge/life/duty_shares.h"

#include <algorithm>
#include <optional>

#include "pipelines/base/names/name_lists.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;

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

/// Values by a history's own effects as values by the effects of all blocks.
VectorXd DutyShares::on_all(const VectorXd& own, const std::vector<std::string>& names) const {
  VectorXd result = VectorXd::Zero(n_effects());
  for (std::size_t e = 0; e < names.size(); ++e)
    result[std::find(effects_.begin(), effects_.end(), names[e]) - effects_.begin()] += own[Index(e)];
  return result;
}

VectorXd DutyShares::running(const PlaceInBlock& at, const WeighedCycles& weighed, const SlopesOf& slopes_of,
                             const SnCurve& curve, const SupportSlopes& support,
                             const Vector6* moving) const {
  DamageDerivative derivative(at.unit_Pa, *at.block.running, &at.course);
  double sum = 0;
  for (std::size_t i = 0; i < weighed.cycles.size(); ++i) {
    const double weight = damage_slope(curve, weighed.blocks[i]);
    derivative.add(weighed.cycles[i], slopes_of(weighed.cycles[i]), weight, moving);
    sum += weight;
  }
  derivative.add(support, sum);
  return on_all(derivative.by_effect(), at.block.running->effects);
}

VectorXd DutyShares::starting(const PlaceInBlock& at, const WeighedCycles& start,
                              const WeighedCycles& its_running, const SlopesOf& slopes_of,
                              const SnCurve& curve, const SupportSlopes& support) const {
  if (!(miner_damage(curve, start.blocks) > miner_damage(curve, its_running.blocks)))
    return VectorXd::Zero(n_effects());
  const auto* transient = at.block.starting;
  const double n_before = transient != nullptr ? double(transient->values.cols()) : 1;
  DamageDerivative running(at.unit_Pa, *at.block.running, &at.course);
  std::optional<DamageDerivative> before;
  if (transient != nullptr) before.emplace(at.unit_Pa, *transient, nullptr);
  double sum = 0;
  /// @param first  column of the running's first place
  const auto add = [&](const WeighedCycles& weighed, double sign, double first) {
    for (std::size_t i = 0; i < weighed.cycles.size(); ++i) {
      const auto& cycle = weighed.cycles[i];
      const auto slopes = slopes_of(cycle);
      const double weight = sign * damage_slope(curve, weighed.blocks[i]);
      const auto add_end = [&](double column, const Vector6& by_stress) {
        if (column >= first)
          running.add(column - first, weight * by_stress);
        else if (before)
          before->add(column, weight * by_stress);
      };
      add_end(cycle.from_instant, slopes.by_from);
      add_end(cycle.to_instant, slopes.by_to);
      sum += weight;
    }
  };
  add(start, 1, n_before);
  add(its_running, -1, 0);
  running.add(support, sum);
  VectorXd result = on_all(running.by_effect(), at.block.running->effects);
  if (before) result += on_all(before->by_effect(), transient->effects);
  return result;
}

}  // namespace pipelines
