#include "pipelines/judge/life/fatigue_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "pipelines/judge/analysis/stress_under_changed_loads.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/judge/life/damage_direction.h"
#include "pipelines/superpose/between_instants/cycle_extremes.h"
#include "pipelines/superpose/envelope/nodal_cycles.h"
#include "pipelines/superpose/envelope/stress_shares.h"

namespace pipelines {
namespace {

Stress as_stress(const Eigen::Matrix<double, 6, 1>& components) {
  Stress stress{};
  Eigen::Map<Eigen::Matrix<double, 6, 1>>(stress.data()) = components;
  return stress;
}

constexpr double slack_of_search = 1e-6;
constexpr double life_without_wish_s = 1e8;
/// Share by which ends of a cycle between the places of the search may leave the polynomial.
constexpr double off_the_polynomial = 1e-3;
constexpr double places_per_period = 48, places_in_search = 24;

}  // namespace

std::vector<NodesOfFeature> nodes_by_feature(const Superposed& analysis) {
  const auto& nodes = analysis.responses.nodes;
  std::map<int, std::string> name_of;
  for (const auto& feature : analysis.mesh.features) name_of[feature.boundary_id] = feature.name;
  for (const auto& notch : analysis.mesh.notches) name_of.erase(notch.boundary_id);
  std::map<std::string, std::vector<std::size_t>> result;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    if (const auto name = name_of.find(nodes.face_boundary_id[f]); name != name_of.end())
      for (const auto node : nodes.face(f))
        if (!analysis.places.excluded[std::size_t(node)]) result[name->second].push_back(std::size_t(node));
  for (auto& [name, list] : result) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return {result.begin(), result.end()};
}

bool damages_more(const FatigueRules& rules, const std::vector<StressBlock>& blocks,
                  const std::vector<StressBlock>& others, double duration_s) {
  const auto curve = rules.design_curve(blocks), of_others = rules.design_curve(others);
  const double damage = miner_damage(curve, blocks), damage_of_others = miner_damage(of_others, others);
  if (damage != damage_of_others) return damage > damage_of_others;
  constexpr double never = std::numeric_limits<double>::infinity();
  const double repetitions = rules.scene().wanted_life_s.value_or(life_without_wish_s) / duration_s;
  return life_factor(curve, blocks, repetitions).value_or(never) <
         life_factor(of_others, others, repetitions).value_or(never);
}

Eigen::ArrayXd channel_sizes_Pa(const fem::UnitResponses& responses) {
  Eigen::ArrayXd sizes = Eigen::ArrayXd::Zero(Eigen::Index(responses.channels.size()));
  for (const auto node : surface_nodes(responses.nodes)) {
    const auto unit = unit_stresses_at(responses, node);
    for (Eigen::Index k = 0; k < unit.cols(); ++k)
      sizes[k] = std::max(sizes[k], von_mises_Pa(as_stress(unit.col(k))));
  }
  return sizes;
}

FatiguePlaces::FatiguePlaces(const Judged& analysis, const SurfaceSlopes& slopes, const ChannelHistory& loads,
                             const std::vector<double>& largest_Pa, const FatigueRules& rules)
    : analysis_(analysis),
      slopes_(slopes),
      loads_(loads),
      largest_Pa_(largest_Pa),
      rules_(rules),
      course_(loads.values, channel_sizes_Pa(analysis.responses), places_per_period),
      of_search_(loads.values, channel_sizes_Pa(analysis.responses), places_in_search),
      bound_(of_search_, channel_sizes_Pa(analysis.responses)),
      half_ranges_(0.5 * (course_.fine().rowwise().maxCoeff() - course_.fine().rowwise().minCoeff()) +
                   course_.missed_by_places()),
      missed_(course_.missed_by_instants()),
      most_per_Pa_(rules.scene().safety /
                   (rules.limit(0, {}).reversed_Pa * rules.least_mean_stress_factor())) {}

std::vector<FatigueNode> FatiguePlaces::worst_of(const std::vector<std::size_t>& nodes) const {
  std::vector<std::pair<double, std::size_t>> by_bound;
  for (const auto node : nodes) by_bound.emplace_back(most_utilisation(node), node);
  std::stable_sort(by_bound.begin(), by_bound.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  FatigueNode worst;
  for (const auto& [bound, node] : by_bound) {
    if (bound <= worst.utilisation) break;
    const auto unit = unit_stresses_at(analysis_.responses, node);
    if (worst.utilisation > 0 && is_surely_within(worst.utilisation, unit)) continue;
    auto candidate = judged(node, bound_.stress_of(unit, of_search_), slack_of_search, worst.utilisation);
    if (candidate.utilisation > worst.utilisation) worst = candidate;
  }
  std::vector<FatigueNode> result;
  if (nodes.empty()) return result;
  result.push_back(at(worst.node));
  if (course_.orders().size() < 2) return result;
  std::size_t by_harmonics = worst.node;
  double most = harmonics_damage_about(by_harmonics) * (1 + slack_of_search);
  for (const auto node : nodes)
    if (const double damage = harmonics_damage_about(node); damage > most) {
      most = damage;
      by_harmonics = node;
    }
  if (by_harmonics != worst.node) result.push_back(at(by_harmonics));
  return result;
}

/// Largest amplitude that a node can have. Half of the difference of two stresses has at most the larger von
/// Mises stress of both, which the instants tell but for what they miss, and at most the sum of the channels'
/// own: exact zero where no channel changes.
double FatiguePlaces::most_amplitude_Pa(std::size_t node, const UnitStresses& unit) const {
  double of_channels_Pa = 0, missed_Pa = 0;
  for (Eigen::Index k = 0; k < unit.cols(); ++k) {
    const double size_Pa = von_mises_Pa(as_stress(unit.col(k)));
    of_channels_Pa += half_ranges_[k] * size_Pa;
    missed_Pa += missed_[k] * size_Pa;
  }
  return std::min(of_channels_Pa, largest_Pa_[node] + missed_Pa);
}

/// Largest utilisation that a node can have, without support by the gradient. Two stresses of a ball of
/// radius R that differ by twice a have their middle within sqrt(R^2 - a^2) of its centre. What is equivalent
/// at R = -1 grows with the amplitude by one at least and with the mean by M at most. So a smaller than A,
/// the largest, may win by M sqrt(R^2 - a^2) - (A - a), no more, of which the largest is at a = R / sqrt(1 +
/// M^2), or at A below that.
double FatiguePlaces::most_utilisation(const StressBall& ball, double amplitude_Pa) const {
  const double R = ball.radius_Pa * (1 + off_the_polynomial),
               A = std::min(amplitude_Pa * (1 + off_the_polynomial), R);
  const auto limit = rules_.limit(0, {A, ball.mean_Pa});
  const double M = limit.mean_stress_sensitivity, slope = std::hypot(1, M);
  const double by_mean_Pa = A * slope < R ? M * std::sqrt(R * R - A * A) : R * slope - A;
  return limit.utilisation + rules_.scene().safety / limit.reversed_Pa * by_mean_Pa;
}

double FatiguePlaces::most_utilisation(std::size_t node) const {
  const auto unit = unit_stresses_at(analysis_.responses, node);
  const auto ball = bound_.about_mean(unit);
  return std::min(most_per_Pa_ * most_amplitude_Pa(node, unit), most_utilisation(ball, ball.radius_Pa));
}

bool FatiguePlaces::is_surely_within(double utilisation, const UnitStresses& unit_Pa) const {
  for (std::size_t level = 0; level < AmplitudeBound::n_levels; ++level) {
    const auto most = bound_.at_knots(unit_Pa, level);
    if (most_utilisation(most.ball, most.amplitude_Pa) <= utilisation) return true;
  }
  return false;
}

/// Damage of a node's harmonics, up to a factor: sum of h A_h^k over the orders, A_h the larger half axis of
/// the deviator's ellipse.
double FatiguePlaces::harmonics_damage_about(std::size_t node) const {
  const auto unit = unit_stresses_at(analysis_.responses, node);
  const auto coordinates = deviatoric_coordinates(unit);
  double damage = 0;
  for (Eigen::Index i = 0; i < course_.orders().size(); ++i) {
    const Eigen::VectorXcd line = coordinates.matrix() * course_.strongest().col(i).matrix();
    const double axis_squared = (line.squaredNorm() + std::abs(line.cwiseProduct(line).sum())) / 2;
    damage += course_.orders()[i] *
              std::pow(std::sqrt(axis_squared) / rules_.limit(0, {}).reversed_Pa, rules_.group().slope);
  }
  return damage;
}

/// Half of the change of the channels between two places of the course. Between two instants only they count,
/// and the weights of the others need not be taken.
Eigen::VectorXd FatiguePlaces::half_change(double from, double to) const {
  const auto first = course_.instant_alone(from), second = course_.instant_alone(to);
  if (first && second) return 0.5 * (loads_.values.col(*second) - loads_.values.col(*first)).matrix();
  return 0.5 * (loads_.values.matrix() * (course_.weights_at(to) - course_.weights_at(from)));
}

double FatiguePlaces::gradient_per_m(std::size_t node, double from, double to) const {
  if (!has_gradients()) return 0;
  const Eigen::VectorXd loads = half_change(from, to);
  return slopes_.related_gradient_per_m(node, [&](std::size_t other) {
    return von_mises_Pa(as_stress(unit_stresses_at(analysis_.responses, other) * loads));
  });
}

/// With f von Mises stress and S its slope inwards, G = -S / f: dG = -(dS + G df) / f.
SupportSlopes FatiguePlaces::support_slopes(std::size_t node, const CountedNode& counted) const {
  const double gradient = gradient_per_m(node, counted.from, counted.to);
  if (!(gradient > 0)) return {};
  const Eigen::VectorXd loads = half_change(counted.from, counted.to);
  const auto slopes_at = [&](std::size_t other) -> Eigen::VectorXd {
    const auto unit = unit_stresses_at(analysis_.responses, other);
    return unit.transpose() * form_along(direction_of(as_stress(unit * loads)));
  };
  const Eigen::VectorXd here = slopes_at(node);
  Eigen::VectorXd by_load = gradient * here;
  for (const auto& [other, weight] : slopes_.inward_weights(node))
    by_load += weight * (slopes_at(other) - here);
  constexpr double step = 1e-4;  // off by its square
  const auto log_support = [&](double factor) {
    return std::log(rules_.limit(factor * gradient, {}).support);
  };
  const double by_log_gradient = (log_support(1 + step) - log_support(1 - step)) / (2 * step);
  const double stress_Pa = here.dot(loads);
  return {by_log_gradient / (gradient * stress_Pa) * 0.5 * by_load, counted.from, counted.to,
          form_along(counted.direction)};
}

FatigueNode FatiguePlaces::judged(std::size_t node, const StressCourse& course, double slack,
                                  double known) const {
  FatigueNode result;
  result.node = node;
  const auto found = course.largest(slack);
  result.cycle = found.cycle;
  result.from = found.from;
  result.to = found.to;
  result.utilisation = rules_.limit(0, scalar(result.cycle)).utilisation;
  if (!(result.cycle.amplitude_Pa > 0) || result.utilisation <= known) return result;
  result.gradient_per_m = gradient_per_m(node, result.from, result.to);
  result.utilisation = rules_.limit(result.gradient_per_m, scalar(result.cycle)).utilisation;
  return result;
}

FatigueNode FatiguePlaces::at(std::size_t node) const {
  return judged(node, stress_of(node), 0, -1);
}

StressCourse FatiguePlaces::stress_of(std::size_t node) const {
  return {unit_stresses_at(analysis_.responses, node), course_};
}

CountedNode FatiguePlaces::counted_along(const DeviatoricDirection& direction, std::size_t node,
                                         const StressCourse& course) const {
  CountedNode counted;
  const auto cycles = course.cycles_along(direction);
  if (cycles.empty()) return counted;
  const auto largest = std::max_element(cycles.begin(), cycles.end(),
                                        [](const auto& a, const auto& b) { return a.range_Pa < b.range_Pa; });
  counted.direction = direction;
  counted.amplitude_Pa = largest->range_Pa / 2;
  counted.from = largest->from_instant;
  counted.to = largest->to_instant;
  counted.limit = rules_.limit(gradient_per_m(node, counted.from, counted.to),
                               scalar(cycle_between(largest->from, largest->to, 0, 1)));
  counted.blocks = rules_.counted(cycles, counted.limit);
  return counted;
}

CountedNode FatiguePlaces::counted(const FatigueNode& node, double duration_s) const {
  CountedNode worst;
  if (!(node.cycle.amplitude_Pa > 0)) return worst;
  const auto course = stress_of(node.node);
  const auto limit = rules_.limit(node.gradient_per_m, scalar(node.cycle));
  const auto about = [&](const DeviatoricDirection& direction) {
    return elementary_damage(rules_.counted(course.cycles_along(direction, false), limit),
                             rules_.group().slope);
  };
  for (const auto& direction :
       damage_directions(course.coordinates(), direction_of(node.cycle.half_range_Pa), about)) {
    auto one = counted_along(direction, node.node, course);
    if (!one.blocks.empty() &&
        (worst.blocks.empty() || damages_more(rules_, one.blocks, worst.blocks, duration_s)))
      worst = std::move(one);
  }
  return worst;
}

CountedNode FatiguePlaces::stationary(const FatigueNode& node, const CountedNode& counted) const {
  if (counted.blocks.empty()) return counted;
  const auto course = stress_of(node.node);
  const auto curve = curve_with_damage(rules_.design_curve(counted.blocks), counted.blocks);
  const auto direction = stationary_direction(counted.direction, [&](const DeviatoricDirection& turned) {
    return miner_damage(curve, counted_along(turned, node.node, course).blocks);
  });
  return direction == counted.direction ? counted : counted_along(direction, node.node, course);
}

double FatiguePlaces::unresolved_share(const FatigueNode& node, const CountedNode& counted) const {
  const bool are_told = loads_.passed_over.cols() == 0;
  if ((course_.is_resolved() && are_told) || !(counted.amplitude_Pa > 0)) return 0;
  const Eigen::VectorXd middle =
      0.5 * (loads_.values.matrix() * (course_.weights_at(node.from) + course_.weights_at(node.to)));
  const auto unit = unit_stresses_at(analysis_.responses, node.node);
  std::vector<std::array<double, 6>> tensors(std::size_t(unit.cols()));
  for (Eigen::Index k = 0; k < unit.cols(); ++k) tensors[std::size_t(k)] = as_stress(unit.col(k));
  double more_Pa = 0;
  if (!course_.is_resolved()) {
    const auto sampling = time_sampling(tensors, loads_.values.colwise() - middle.array());
    more_Pa = course_.is_polynomial() ? sampling.unresolved_Pa : sampling.error_Pa();
  }
  if (!are_told) {
    const Eigen::ArrayXXd change = loads_.passed_over.colwise() - middle.array();
    more_Pa = std::max(more_Pa, largest_von_mises_Pa(tensors.front().data(), change) - counted.amplitude_Pa);
  }
  return more_Pa / counted.amplitude_Pa;
}

BodyLoads FatiguePlaces::half_change_between(double from, double to) const {
  const auto half_change = [](const Eigen::ArrayXXd& ends) -> Eigen::ArrayXXd {
    return 0.5 * (ends.col(1) - ends.col(0));
  };
  BodyLoads result;
  result.unit_loads = analysis_.loads.unit_loads;
  result.history = between(from, to);
  result.history.values = half_change(result.history.values);
  for (auto& part : result.history.by_effect) part = half_change(part);
  return result;
}

ChannelHistory FatiguePlaces::between(double from, double to) const {
  Eigen::MatrixXd weights(loads_.values.cols(), 2);
  weights << course_.weights_at(from), course_.weights_at(to);
  ChannelHistory result{loads_.body, loads_.channels, loads_.effects, {}, {}};
  result.values = (loads_.values.matrix() * weights).array();
  for (const auto& part : loads_.by_effect) result.by_effect.push_back((part.matrix() * weights).array());
  return result;
}

}  // namespace pipelines
