/// The nodes that fatigue uses up most, by feature of the surface.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipelines/analysis/body_analysis.h"
#include "pipelines/analysis/fatigue_rules.h"
#include "pipelines/analysis/stress_gradient.h"

namespace pipelines {

using NodesOfFeature = std::pair<std::string, std::vector<std::size_t>>;

/// The nodes of each feature outside the exclusion distances; one on a seam belongs to both. By name.
std::vector<NodesOfFeature> nodes_by_feature(const BodyAnalysis& analysis);

/// A node under one history of loads.
struct FatigueNode {
  std::size_t node = 0;
  StressCycle cycle{};        ///< exact: no pair of instants differs more
  double gradient_per_m = 0;  ///< related stress gradient of the amplitude
  double utilisation = -1;    ///< of what is allowed: j_D over the safety against endurance
};

class FatiguePlaces {
public:
  /// @param analysis   of the body: nodes, unit responses
  /// @param loads      with the channels of the unit responses
  /// @param largest_Pa von Mises stress over the cycle at most, by node
  /// All outlive this.
  FatiguePlaces(const BodyAnalysis& analysis, const SurfaceSlopes& slopes, const ChannelHistory& loads,
                const std::vector<double>& largest_Pa, const FatigueRules& rules);

  /// The most used one of these nodes, to a millionth of its amplitude: they are looked at by falling bound
  /// of it, until no other can reach what is found.
  FatigueNode worst_of(const std::vector<std::size_t>& nodes) const;

  /// @param slack  of the largest cycle (stress_cycle.h)
  FatigueNode at(std::size_t node, double slack = 0) const;

private:
  double most_amplitude_Pa(std::size_t node) const;

  const BodyAnalysis& analysis_;
  const SurfaceSlopes& slopes_;
  const ChannelHistory& loads_;
  const std::vector<double>& largest_Pa_;
  const FatigueRules& rules_;
  Eigen::ArrayXd half_ranges_;  // of the channels
  double most_per_Pa_;          // bound of the utilisation per von Mises stress
};

}  // namespace pipelines
