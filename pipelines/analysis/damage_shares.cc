#include "pipelines/analysis/damage_shares.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipelines/superposition/stress_shares.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Steps of instants for derivatives of a polynomial whose shortest period is two instants: off by
/// (pi h)^2 / 12 = 1e-4.
constexpr double step_of_instants = 0.01;
/// Cycles that together have less of the damage than this are left out: of shares in per cent nobody sees it,
/// and hundreds of small cycles cost as much as the large ones.
constexpr double least_of_damage = 1e-5;

Vector6 vector_of(const Stress& stress) {
  return Eigen::Map<const Vector6>(stress.data());
}

}  // namespace

std::vector<std::size_t> cycles_that_matter(const std::vector<double>& weights) {
  std::vector<std::size_t> order(weights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return weights[a] < weights[b]; });
  double left = least_of_damage * std::accumulate(weights.begin(), weights.end(), 0.0);
  std::size_t n_dropped = 0;
  for (; n_dropped < order.size(); ++n_dropped)
    if ((left -= weights[order[n_dropped]]) < 0) break;
  order.erase(order.begin(), order.begin() + std::ptrdiff_t(n_dropped));
  std::sort(order.begin(), order.end());
  return order;
}

AmplitudeSlopes slopes_of_range(const EndsOfCycle& cycle, const Vector6& form) {
  const double range = form.dot(vector_of(cycle.to) - vector_of(cycle.from));
  if (range == 0) return {Vector6::Zero(), Vector6::Zero()};
  return {-form / range, form / range};
}

AmplitudeSlopes slopes_of_equivalent(const EndsOfCycle& cycle, const Vector6& form,
                                     double mean_stress_sensitivity) {
  const double half_range = form.dot(vector_of(cycle.to) - vector_of(cycle.from)) / 2;
  const auto middle = cycle_between(cycle.from, cycle.to, 0, 1);
  const CyclicStress stress{std::abs(half_range), middle.signed_mean_Pa};
  const double amplitude_Pa = equivalent_reversed_amplitude_Pa(stress, mean_stress_sensitivity);
  if (!(amplitude_Pa > 0)) return {Vector6::Zero(), Vector6::Zero()};
  const auto by = equivalent_amplitude_slopes(stress, mean_stress_sensitivity);
  const Vector6 by_range = (half_range > 0 ? 0.5 : -0.5) * by.by_amplitude / amplitude_Pa * form;
  const Vector6 by_mean =
      0.5 * by.by_mean / amplitude_Pa * vector_of(signed_von_mises_slopes(middle.mean_Pa));
  return {by_mean - by_range, by_mean + by_range, by_mean};
}

SnCurve curve_of_shares(SnCurve curve, const std::vector<StressBlock>& blocks) {
  if (miner_damage(curve, blocks) > 0) return curve;
  double largest_Pa = 0;
  for (const auto& block : blocks)
    if (block.count > 0) largest_Pa = std::max(largest_Pa, block.amplitude_Pa);
  if (largest_Pa > 0) curve.knee_amplitude_Pa = largest_Pa;
  curve.second_slope = curve.slope;
  return curve;
}

double damage_slope(const SnCurve& curve, const StressBlock& block) {
  const auto cycles = cycles_to_failure(curve, block.amplitude_Pa);
  if (!cycles) return 0;
  const bool is_above = block.amplitude_Pa > curve.knee_amplitude_Pa;
  return (is_above ? curve.slope : curve.second_slope.value_or(curve.slope)) * block.count / *cycles;
}

DamageDerivative::DamageDerivative(const UnitStresses& unit_Pa, const ChannelHistory& loads,
                                   const FactorCourse* course)
    : unit_Pa_(unit_Pa), loads_(loads), course_(course), by_stress_(MatrixXd::Zero(loads.values.cols(), 6)) {}

VectorXd DamageDerivative::weights_at(double instant) const {
  if (course_ != nullptr) return course_->weights_at(instant);
  return VectorXd::Unit(by_stress_.rows(), Index(instant));
}

void DamageDerivative::add(double instant, const Vector6& by_stress) {
  by_stress_.noalias() += weights_at(instant) * by_stress.transpose();
}

void DamageDerivative::add(const EndsOfCycle& cycle, const AmplitudeSlopes& slopes, double weight,
                           const Vector6* moving) {
  const auto add_end = [&](double instant, const Vector6& by_stress) {
    add(instant, weight * by_stress);
    if (moving == nullptr || slopes.by_mean.isZero(0)) return;
    const VectorXd here = weights_at(instant), before = weights_at(instant - step_of_instants),
                   after = weights_at(instant + step_of_instants);
    const VectorXd slope = (after - before) / (2 * step_of_instants);
    const VectorXd curvature = (after - 2 * here + before) / (step_of_instants * step_of_instants);
    const auto stress = [&](const VectorXd& weights) -> Vector6 {
      return unit_Pa_ * (loads_.values.matrix() * weights);
    };
    const double bend = moving->dot(stress(curvature));
    if (bend == 0) return;
    // The form's slope stays zero: the end moves by -(slope of the part) / bend.
    const double by_move = weight * slopes.by_mean.dot(stress(slope));
    by_stress_.noalias() -= slope * (by_move / bend * moving->transpose());
  };
  add_end(cycle.from_instant, slopes.by_from);
  add_end(cycle.to_instant, slopes.by_to);
}

void DamageDerivative::add(const SupportSlopes& support, double weight) {
  if (support.by_change.isZero(0)) return;
  if (by_load_.size() == 0) by_load_ = MatrixXd::Zero(loads_.values.rows(), loads_.values.cols());
  const VectorXd weights = weights_at(support.to) - weights_at(support.from);
  by_load_.noalias() += weight * support.by_change * weights.transpose();
}

/// dD / d loads, channels x instants.
MatrixXd DamageDerivative::by_loads() const {
  MatrixXd result = unit_Pa_.transpose() * by_stress_.transpose();
  if (by_load_.size() > 0) result += by_load_;
  return result;
}

VectorXd DamageDerivative::by_effect() const {
  const MatrixXd by_load = by_loads();
  VectorXd result(Index(loads_.effects.size()));
  for (Index e = 0; e < result.size(); ++e)
    result[e] = (by_load.array() * loads_.by_effect[std::size_t(e)]).sum();
  return result;
}

VectorXd DamageDerivative::by_channel() const {
  return (by_loads().array() * loads_.values).rowwise().sum();
}

std::vector<double> shares_of(const VectorXd& derivative) {
  const double sum = derivative.sum();
  if (!(sum > 0)) return {};
  std::vector<double> shares(std::size_t(derivative.size()));
  VectorXd::Map(shares.data(), derivative.size()) = derivative / sum;
  return shares;
}

StressShares shares_in_damage(const BodyAnalysis& analysis, const ChannelHistory& loads,
                              const FatiguePlaces& search, const FatigueRules& rules, const FatigueNode& node,
                              const CountedNode& counted, bool with_channels) {
  StressShares shares;
  if (counted.blocks.empty()) return shares;
  const auto curve = curve_of_shares(rules.design_curve(counted.blocks), counted.blocks);
  const auto stress = search.stress_of(node.node);
  const Vector6 form = form_along(counted.direction);
  const auto cycles = stress.cycles_along(counted.direction);
  std::vector<double> weights;
  double sum = 0;
  for (const auto& block : counted.blocks) sum += weights.emplace_back(damage_slope(curve, block));
  const UnitStresses unit_Pa = unit_stresses_at(analysis.responses, node.node);
  DamageDerivative derivative(unit_Pa, loads, &search.course());
  for (const auto i : cycles_that_matter(weights))
    derivative.add(cycles[i], slopes_of_equivalent(cycles[i], form, counted.limit.mean_stress_sensitivity),
                   weights[i], stress.is_smooth() ? &form : nullptr);
  derivative.add(search.support_slopes(node.node, counted.from, counted.to), sum);
  shares.effects = shares_of(derivative.by_effect());
  if (with_channels) shares.channels = shares_of(derivative.by_channel());
  return shares;
}

std::vector<double> shares_in_damage(const WeldPlace& place, const ChannelHistory& loads,
                                     const FactorCourse& course, const ToeStress& toe, const SnCurve& curve) {
  const auto cycles = StressCourse(place.unit_Pa, course).cycles_of(toe.form);
  std::vector<StressBlock> blocks;
  for (const auto& cycle : cycles) blocks.push_back({cycle.range_Pa, 1});
  const auto of_shares = curve_of_shares(curve, blocks);
  DamageDerivative derivative(place.unit_Pa, loads, &course);
  std::vector<double> weights;
  for (const auto& block : blocks) weights.push_back(damage_slope(of_shares, block));
  for (const auto i : cycles_that_matter(weights))
    derivative.add(cycles[i], slopes_of_range(cycles[i], toe.form), weights[i]);
  return shares_of(derivative.by_effect());
}

}  // namespace pipelines
