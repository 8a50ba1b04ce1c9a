/// The nodes that fatigue uses up most, by feature of the surface.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/figures/stress_gradient.h"
#include "pipelines/judge/life/fatigue_rules.h"
#include "pipelines/superpose/between_instants/amplitude_bound.h"
#include "pipelines/superpose/between_instants/factor_course.h"

namespace pipelines {

using NodesOfFeature = std::pair<std::string, std::vector<std::size_t>>;

/// The nodes of each feature outside the exclusion distances; one on a seam belongs to both. By name. The
/// roundings of welds are left out: their stress is judged by classes of welds (weld_places.h).
std::vector<NodesOfFeature> nodes_by_feature(const Superposed& analysis);

/// A node under one history of loads.
struct FatigueNode {
  std::size_t node = 0;
  StressCycle cycle{};        ///< no pair of instants differs more, nor of what lies between them
  double from = 0, to = 0;    ///< its instants: i + share of the step to the next
  double gradient_per_m = 0;  ///< related stress gradient of the amplitude
  double utilisation = -1;    ///< j_D over the safety against endurance: the share of what is allowed
};

/// A node's cycles, counted along the direction in which they damage most (damage_direction.h).
struct CountedNode {
  std::vector<StressBlock> blocks;  ///< shares of what is endured, of one period
  double amplitude_Pa = 0;          ///< amplitude of the largest of them, along the direction
  DeviatoricDirection direction = DeviatoricDirection::Zero();
  EnduranceLimit limit;     ///< with the gradient of that largest one
  double from = 0, to = 0;  ///< the instants of that gradient: i + share of the step to the next
};

/// d ln(1 / sigma_WK) by the loads of a cycle: what they do to the support by the stress gradient.
struct SupportSlopes {
  /// Slopes by the change of each channel's load between the instants [1/unit]; empty: no support.
  Eigen::VectorXd by_change;
  double from = 0, to = 0;  ///< i + share of the step to the next
  Eigen::Matrix<double, 6, 1> form = Eigen::Matrix<double, 6, 1>::Zero();  ///< they are its turning points
};

/// Whether blocks do more damage than others; of those that do none, leave less of a factor on all stresses
/// until they would within the wanted life (without one, within three years).
/// @param duration_s  in which the blocks happen once
bool damages_more(const FatigueRules& rules, const std::vector<StressBlock>& blocks,
                  const std::vector<StressBlock>& others, double duration_s);

/// The von Mises stress that one unit of each channel brings to a surface at most [Pa].
Eigen::ArrayXd channel_sizes_Pa(const fem::UnitResponses& responses);

class FatiguePlaces {
public:
  /// @param analysis   analysis of the body: nodes, unit responses
  /// @param loads      with the channels of the unit responses
  /// @param largest_Pa von Mises stress over the cycle at most, by node
  /// All outlive this.
  FatiguePlaces(const Judged& analysis, const SurfaceSlopes& slopes, const ChannelHistory& loads,
                const std::vector<double>& largest_Pa, const FatigueRules& rules);

  /// The most used one of these nodes: they are looked at by falling bound of their use, between the
  /// instants too, until no other can reach what is found; each at 24 places in a period of the highest
  /// harmonic, which miss 0.9 % at most. And, if another, the one where the harmonics by themselves, each as
  /// often as its order, do most damage: many cycles may do more than a larger one.
  std::vector<FatigueNode> worst_of(const std::vector<std::size_t>& nodes) const;

  FatigueNode at(std::size_t node) const;

  /// Cycles counted along the worst direction to some percent of its damage, which tells nodes apart.
  /// @param duration_s  duration of the period
  CountedNode counted(const FatigueNode& node, double duration_s) const;
  /// Cycles counted along the direction near by from which turning changes the damage in second order only.
  CountedNode stationary(const FatigueNode& node, const CountedNode& counted) const;

  /// Share by which the amplitude may be larger than at the instants, or on the polynomial through them, as a
  /// share of that of the counted cycles, and at samples that they pass over; 0 where the instants resolve
  /// the loads (time_sampling.h).
  double unresolved_share(const FatigueNode& node, const CountedNode& counted) const;

  /// The loads, at 48 places in a period of the highest harmonic.
  const FactorCourse& course() const { return course_; }
  StressCourse stress_of(std::size_t node) const;

  SupportSlopes support_slopes(std::size_t node, const CountedNode& counted) const;

  /// The loads at two instants or between them.
  ChannelHistory between(double from, double to) const;
  /// Half of the change of the loads between two instants, as loads of one instant.
  BodyLoads half_change_between(double from, double to) const;

private:
  CountedNode counted_along(const DeviatoricDirection& direction, std::size_t node,
                            const StressCourse& course) const;
  double most_utilisation(std::size_t node) const;
  double most_amplitude_Pa(std::size_t node, const UnitStresses& unit_Pa) const;
  double most_utilisation(const StressBall& ball, double amplitude_Pa) const;
  /// Whether a few places tell that a node's utilisation is no larger.
  bool is_surely_within(double utilisation, const UnitStresses& unit_Pa) const;
  double harmonics_damage_about(std::size_t node) const;
  /// Half of the change of the loads, one of each channel.
  Eigen::VectorXd half_change(double from, double to) const;
  /// Whether the responses tell the related gradient; a beam's do not.
  bool has_gradients() const { return analysis_.method != Method::beam; }
  double gradient_per_m(std::size_t node, double from, double to) const;
  /// @param known  a utilisation: where this one is not above it, it may be without support
  FatigueNode judged(std::size_t node, const StressCourse& course, double slack, double known) const;

  const Judged& analysis_;
  const SurfaceSlopes& slopes_;
  const ChannelHistory& loads_;
  const std::vector<double>& largest_Pa_;
  const FatigueRules& rules_;
  FactorCourse course_, of_search_;
  AmplitudeBound bound_;
  Eigen::ArrayXd half_ranges_;  // half ranges of the channels
  Eigen::ArrayXd missed_;       // part of each channel that the instants miss
  double most_per_Pa_;          // bound of the utilisation per von Mises stress
};

}  // namespace pipelines
