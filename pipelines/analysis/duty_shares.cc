#include "pipelines/analysis/duty_shares.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipelines/common/name_lists.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// @param sign  of the damage
/// @return the sum of the weights
double add_cycles(const WeighedCycles& weighed, const SnCurve& curve, const SlopesOf& slopes_of,
                  const PartsAt& parts, double sign, const Eigen::Matrix<double, 6, 1>* moving,
                  DamageDerivative& derivative) {
  std::vector<double> weights;
  for (const auto& block : weighed.blocks) weights.push_back(damage_slope(curve, block));
  for (const auto i : cycles_that_matter(weights))
    derivative.add(weighed.cycles[i], slopes_of(weighed.cycles[i]), parts, sign * weights[i], moving);
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

Index DutyShares::index_of(const std::string& effect) const {
  return std::find(effects_.begin(), effects_.end(), effect) - effects_.begin();
}

/// Parts by a history's own effects, in the columns of those of all blocks.
PartStresses DutyShares::on_all(const PartStresses& own, const std::vector<std::string>& names) const {
  PartStresses result = PartStresses::Zero(6, n_effects());
  for (std::size_t e = 0; e < names.size(); ++e) result.col(index_of(names[e])) += own.col(Index(e));
  return result;
}

PartsAt DutyShares::running_parts(const PlaceInBlock& at) const {
  const auto& running = *at.block.running;
  return [this, &running, own = parts_by_effect(at.unit_Pa, running, at.course)](double instant) {
    return on_all(own(instant), running.effects);
  };
}

/// At the columns of the start sequence.
PartsAt DutyShares::starting_parts(const PlaceInBlock& at) const {
  const auto* starting = at.block.starting;
  const Index n_before = starting != nullptr ? starting->values.cols() : 1;
  return [this, starting, n_before, unit_Pa = at.unit_Pa, running = running_parts(at),
          per_step = double(at.course.per_step())](double column) -> PartStresses {
    const Index i = Index(std::llround(column));
    if (i >= n_before) return running(double(i - n_before) / per_step);
    if (starting == nullptr) return PartStresses::Zero(6, n_effects());
    PartStresses own(6, Index(starting->effects.size()));
    for (Index e = 0; e < own.cols(); ++e)
      own.col(e) = unit_Pa * starting->by_effect[std::size_t(e)].col(i).matrix();
    return on_all(own, starting->effects);
  };
}

VectorXd DutyShares::running(const PlaceInBlock& at, const WeighedCycles& weighed, const SlopesOf& slopes_of,
                             const SnCurve& curve, const VectorXd& support,
                             const Eigen::Matrix<double, 6, 1>* moving) const {
  DamageDerivative derivative(n_effects());
  const double sum = add_cycles(weighed, curve, slopes_of, running_parts(at), 1, moving, derivative);
  if (support.size() > 0) derivative.add(support, sum);
  return derivative.sum();
}

VectorXd DutyShares::starting(const PlaceInBlock& at, const WeighedCycles& start,
                              const WeighedCycles& its_running, const SlopesOf& slopes_of,
                              const SnCurve& curve, const VectorXd& support) const {
  DamageDerivative derivative(n_effects());
  if (!(miner_damage(curve, start.blocks) > miner_damage(curve, its_running.blocks))) return derivative.sum();
  const auto on_places = [running = running_parts(at), per_step = double(at.course.per_step())](
                             double place) { return running(place / per_step); };
  double sum = add_cycles(start, curve, slopes_of, starting_parts(at), 1, nullptr, derivative);
  sum += add_cycles(its_running, curve, slopes_of, on_places, -1, nullptr, derivative);
  if (support.size() > 0) derivative.add(support, sum);
  return derivative.sum();
}

VectorXd DutyShares::support(const FatiguePlaces& places, const FatigueRules& rules, const BlockOnBody& block,
                             std::size_t node, double from, double to) const {
  VectorXd result = VectorXd::Zero(n_effects());
  if (!places.has_gradients()) return result;
  const auto& loads = *block.running;
  const VectorXd weights = places.course().weights_at(to) - places.course().weights_at(from);
  Eigen::MatrixXd by_effect(loads.values.rows(), Index(loads.effects.size()));
  for (Index e = 0; e < by_effect.cols(); ++e)
    by_effect.col(e) = loads.by_effect[std::size_t(e)].matrix() * weights;
  const VectorXd own = support_change(places, rules, node, by_effect.rowwise().sum(), by_effect);
  for (Index e = 0; e < own.size(); ++e) result[index_of(loads.effects[std::size_t(e)])] += own[e];
  return result;
}

}  // namespace pipelines
