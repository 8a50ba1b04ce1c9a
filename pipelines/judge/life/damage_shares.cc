#include "pipelines/judge/life/damage_shares.h"

#include <algorithm>
#include <cmath>

#include "pipelines/superpose/envelope/stress_shares.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Places that are whole but for what instants times steps lose.
constexpr double rounding_of_places = 1e-9;

Vector6 vector_of(const Stress& stress) {
  return Eigen::Map<const Vector6>(stress.data());
}

}  // namespace

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

double damage_slope(const SnCurve& curve, const StressBlock& block) {
  const auto cycles = cycles_to_failure(curve, block.amplitude_Pa);
  if (!cycles) return 0;
  const bool is_above = block.amplitude_Pa > curve.knee_amplitude_Pa;
  return (is_above ? curve.slope : curve.second_slope.value_or(curve.slope)) * block.count / *cycles;
}

DamageDerivative::DamageDerivative(const UnitStresses& unit_Pa, const ChannelHistory& loads,
                                   const FactorCourse* course)
    : unit_Pa_(unit_Pa),
      loads_(loads),
      course_(course),
      by_stress_(MatrixXd::Zero(6, course != nullptr ? course->fine().cols() : loads.values.cols())) {}

void DamageDerivative::spread(const PlacesAround& around, const PlacesAround::Weights& weights,
                              const Vector6& by_stress) {
  for (Index i = 0; i < PlacesAround::n; ++i)
    by_stress_.col(around.wrapped(i, by_stress_.cols())) += weights[i] * by_stress;
}

void DamageDerivative::add(double place, const Vector6& by_stress) {
  const double nearest = std::round(place);
  if (std::abs(place - nearest) < rounding_of_places)
    by_stress_.col(Index(nearest) % by_stress_.cols()) += by_stress;
  else {
    const PlacesAround around(place);
    spread(around, around.value, by_stress);
  }
}

/// A turning point of a form stays one: the form's slope stays zero, so that the place moves by
/// -(slope of the part) / bend.
/// @param by_move  dD by the move of the place, of the loads' slopes there
template <typename ByMove>
void DamageDerivative::add_move(double place, const Vector6& form, const ByMove& by_move) {
  const PlacesAround around(place);
  VectorXd slope = VectorXd::Zero(loads_.values.rows()), curvature = slope;
  for (Index i = 0; i < PlacesAround::n; ++i) {
    const auto loads = course_->fine().matrix().col(around.wrapped(i, by_stress_.cols()));
    slope += around.slope[i] * loads;
    curvature += around.curvature[i] * loads;
  }
  const double bend = form.dot(unit_Pa_ * curvature);
  if (bend != 0) spread(around, around.slope, -by_move(slope) / bend * form);
}

void DamageDerivative::add(const EndsOfCycle& cycle, const AmplitudeSlopes& slopes, double weight,
                           const Vector6* moving) {
  const double per_step = course_ != nullptr ? double(course_->per_step()) : 1;
  const auto add_end = [&](double place, const Vector6& by_stress) {
    add(place, weight * by_stress);
    if (moving == nullptr || slopes.by_mean.isZero(0)) return;
    add_move(place, *moving,
             [&](const VectorXd& loads) { return weight * slopes.by_mean.dot(unit_Pa_ * loads); });
  };
  add_end(cycle.from_instant * per_step, slopes.by_from);
  add_end(cycle.to_instant * per_step, slopes.by_to);
}

void DamageDerivative::add(const SupportSlopes& support, double weight) {
  if (support.by_change.size() == 0) return;
  const VectorXd weights = course_->weights_at(support.to) - course_->weights_at(support.from);
  by_load_ = weight * support.by_change * weights.transpose();
  if (!course_->is_polynomial() || by_stress_.cols() < PlacesAround::n) return;
  const double per_step = double(course_->per_step());
  for (const auto& [instant, sign] : {std::pair(support.from, -1.0), std::pair(support.to, 1.0)})
    add_move(instant * per_step, support.form, [&, of_end = sign * weight](const VectorXd& loads) {
      return of_end * support.by_change.dot(loads);
    });
}

/// dD / d loads, channels x instants.
MatrixXd DamageDerivative::by_loads() const {
  MatrixXd result =
      unit_Pa_.transpose() * (course_ != nullptr ? course_->by_instant(by_stress_) : by_stress_);
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

StressShares shares_in_damage(const Responded& analysis, const ChannelHistory& loads,
                              const FatiguePlaces& search, const FatigueRules& rules, const FatigueNode& node,
                              const CountedNode& counted, bool with_channels) {
  StressShares shares;
  if (counted.blocks.empty()) return shares;
  const auto curve = curve_with_damage(rules.design_curve(counted.blocks), counted.blocks);
  const auto stress = search.stress_of(node.node);
  const Vector6 form = form_along(counted.direction);
  const auto cycles = stress.cycles_along(counted.direction);
  const UnitStresses unit_Pa = unit_stresses_at(analysis.responses, node.node);
  DamageDerivative derivative(unit_Pa, loads, &search.course());
  double sum = 0;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const double weight = damage_slope(curve, counted.blocks[i]);
    derivative.add(cycles[i], slopes_of_equivalent(cycles[i], form, counted.limit.mean_stress_sensitivity),
                   weight, stress.is_smooth() ? &form : nullptr);
    sum += weight;
  }
  derivative.add(search.support_slopes(node.node, counted), sum);
  shares.effects = shares_of(derivative.by_effect());
  if (with_channels) shares.channels = shares_of(derivative.by_channel());
  return shares;
}

std::vector<double> shares_in_damage(const WeldPlace& place, const ChannelHistory& loads,
                                     const FactorCourse& course, const ToeStress& toe, const SnCurve& curve) {
  const auto cycles = StressCourse(place.unit_Pa, course).cycles_of(toe.form);
  std::vector<StressBlock> blocks;
  for (const auto& cycle : cycles) blocks.push_back({cycle.range_Pa, 1});
  const auto of_shares = curve_with_damage(curve, blocks);
  DamageDerivative derivative(place.unit_Pa, loads, &course);
  for (std::size_t i = 0; i < cycles.size(); ++i)
    derivative.add(cycles[i], slopes_of_range(cycles[i], toe.form), damage_slope(of_shares, blocks[i]));
  return shares_of(derivative.by_effect());
}

}  // namespace pipelines
