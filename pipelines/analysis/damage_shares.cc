#include "pipelines/analysis/damage_shares.h"

#include <algorithm>
#include <cmath>
#include <memory>
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

/// Component c of part p in row 6 p + c, a column for each instant.
PartsAt parts_of(std::shared_ptr<const MatrixXd> rows, const FactorCourse& course) {
  return [rows, &course](double instant) -> PartStresses {
    const Index n = rows->cols();
    const double nearest = std::round(instant);
    const VectorXd at = instant == nearest || !course.is_polynomial()
                            ? VectorXd(rows->col((Index(nearest) % n + n) % n))
                            : VectorXd(*rows * course.weights_at(instant));
    return Eigen::Map<const PartStresses>(at.data(), 6, at.size() / 6);
  };
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

PartsAt parts_by_effect(const UnitStresses& unit_Pa, const ChannelHistory& loads,
                        const FactorCourse& course) {
  auto rows = std::make_shared<MatrixXd>(6 * Index(loads.effects.size()), loads.values.cols());
  for (std::size_t e = 0; e < loads.effects.size(); ++e)
    rows->middleRows(6 * Index(e), 6) = unit_Pa * loads.by_effect[e].matrix();
  return parts_of(std::move(rows), course);
}

PartsAt parts_by_channel(const UnitStresses& unit_Pa, const ChannelHistory& loads,
                         const FactorCourse& course) {
  auto rows = std::make_shared<MatrixXd>(6 * unit_Pa.cols(), loads.values.cols());
  for (Index k = 0; k < unit_Pa.cols(); ++k)
    rows->middleRows(6 * k, 6) = unit_Pa.col(k) * loads.values.row(k).matrix();
  return parts_of(std::move(rows), course);
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

void DamageDerivative::add(const EndsOfCycle& cycle, const AmplitudeSlopes& slopes, const PartsAt& parts,
                           double weight, const Vector6* moving) {
  const auto add_end = [&](double instant, const Vector6& by_stress) {
    const PartStresses here = parts(instant);
    sum_ += weight * (here.transpose() * by_stress);
    if (moving == nullptr || slopes.by_mean.isZero(0)) return;
    const PartStresses before = parts(instant - step_of_instants), after = parts(instant + step_of_instants);
    const PartStresses slope = (after - before) / (2 * step_of_instants);
    const Vector6 curvature =
        (after - 2 * here + before).rowwise().sum() / (step_of_instants * step_of_instants);
    const double bend = moving->dot(curvature);
    if (bend == 0) return;
    // The form's slope stays zero: the end moves by -(slope of the part) / bend.
    const VectorXd moves = -(slope.transpose() * *moving) / bend;
    sum_ += weight * slopes.by_mean.dot(slope.rowwise().sum()) * moves;
  };
  add_end(cycle.from_instant, slopes.by_from);
  add_end(cycle.to_instant, slopes.by_to);
}

std::vector<double> shares_of(const VectorXd& derivative) {
  const double sum = derivative.sum();
  if (!(sum > 0)) return {};
  std::vector<double> shares(std::size_t(derivative.size()));
  VectorXd::Map(shares.data(), derivative.size()) = derivative / sum;
  return shares;
}

VectorXd support_change(const FatiguePlaces& search, const FatigueRules& rules, std::size_t node,
                        const VectorXd& change, const MatrixXd& change_of_parts) {
  constexpr double step = 1e-4;  // of a part
  const auto log_support = [&](const VectorXd& loads) {
    return std::log(rules.limit(search.gradient_per_m(node, 0.5 * loads), {}).support);
  };
  VectorXd result(change_of_parts.cols());
  for (Index p = 0; p < result.size(); ++p) {
    const VectorXd part = step * change_of_parts.col(p);
    result[p] = part.isZero(0) ? 0 : (log_support(change - part) - log_support(change + part)) / (2 * step);
  }
  return result;
}

StressShares shares_in_damage(const BodyAnalysis& analysis, const ChannelHistory& loads,
                              const FatiguePlaces& search, const FatigueRules& rules, const FatigueNode& node,
                              const CountedNode& counted, bool with_channels) {
  StressShares shares;
  const auto& course = search.course();
  if (counted.blocks.empty()) return shares;
  const auto curve = curve_of_shares(rules.design_curve(counted.blocks), counted.blocks);
  const auto stress = search.stress_of(node.node);
  const Vector6 form = form_along(counted.direction);
  const auto cycles = stress.cycles_along(counted.direction);
  std::vector<double> weights;
  double sum = 0;
  for (const auto& block : counted.blocks) sum += weights.emplace_back(damage_slope(curve, block));
  const UnitStresses unit = unit_stresses_at(analysis.responses, node.node);
  const auto derivative = [&](const PartsAt& parts, const MatrixXd& change_of_parts) {
    DamageDerivative result(change_of_parts.cols());
    for (const auto i : cycles_that_matter(weights))
      result.add(cycles[i], slopes_of_equivalent(cycles[i], form, counted.limit.mean_stress_sensitivity),
                 parts, weights[i], stress.is_smooth() ? &form : nullptr);
    if (search.has_gradients())
      result.add(support_change(search, rules, node.node, change_of_parts.rowwise().sum(), change_of_parts),
                 sum);
    return shares_of(result.sum());
  };
  const VectorXd weights_of_change = course.weights_at(counted.to) - course.weights_at(counted.from);
  MatrixXd by_effect(loads.values.rows(), Index(loads.effects.size()));
  for (std::size_t e = 0; e < loads.effects.size(); ++e)
    by_effect.col(Index(e)) = loads.by_effect[e].matrix() * weights_of_change;
  shares.effects = derivative(parts_by_effect(unit, loads, course), by_effect);
  if (with_channels)
    shares.channels = derivative(parts_by_channel(unit, loads, course),
                                 VectorXd(loads.values.matrix() * weights_of_change).asDiagonal());
  return shares;
}

std::vector<double> shares_in_damage(const WeldPlace& place, const ChannelHistory& loads,
                                     const FactorCourse& course, const ToeStress& toe, const SnCurve& curve) {
  const auto cycles = StressCourse(place.unit_Pa, course).cycles_of(toe.form);
  std::vector<StressBlock> blocks;
  for (const auto& cycle : cycles) blocks.push_back({cycle.range_Pa, 1});
  const auto of_shares = curve_of_shares(curve, blocks);
  const auto parts = parts_by_effect(place.unit_Pa, loads, course);
  DamageDerivative derivative(Index(loads.effects.size()));
  std::vector<double> weights;
  for (const auto& block : blocks) weights.push_back(damage_slope(of_shares, block));
  for (const auto i : cycles_that_matter(weights))
    derivative.add(cycles[i], slopes_of_range(cycles[i], toe.form), parts, weights[i]);
  return shares_of(derivative.sum());
}

}  // namespace pipelines
