#include "pipelines/analysis/fatigue_places.h"

#include <algorithm>
#include <map>

#include "pipelines/analysis/place_stress.h"
#include "pipelines/superposition/nodal_cycles.h"
#include "pipelines/superposition/stress_shares.h"

namespace pipelines {
namespace {

Stress as_stress(const Eigen::Matrix<double, 6, 1>& components) {
  Stress stress{};
  Eigen::Map<Eigen::Matrix<double, 6, 1>>(stress.data()) = components;
  return stress;
}

constexpr double slack_of_search = 1e-6;

}  // namespace

std::vector<NodesOfFeature> nodes_by_feature(const BodyAnalysis& analysis) {
  const auto& nodes = analysis.responses.nodes;
  std::map<int, std::string> name_of;
  for (const auto& feature : analysis.mesh.features) name_of[feature.boundary_id] = feature.name;
  std::map<std::string, std::vector<std::size_t>> result;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    for (const auto node : nodes.face(f))
      if (!analysis.places.excluded[std::size_t(node)])
        result[name_of.at(nodes.face_boundary_id[f])].push_back(std::size_t(node));
  for (auto& [name, list] : result) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return {result.begin(), result.end()};
}

FatiguePlaces::FatiguePlaces(const BodyAnalysis& analysis, const SurfaceSlopes& slopes,
                             const ChannelHistory& loads, const std::vector<double>& largest_Pa,
                             const FatigueRules& rules)
    : analysis_(analysis),
      slopes_(slopes),
      loads_(loads),
      largest_Pa_(largest_Pa),
      rules_(rules),
      half_ranges_(0.5 * (loads.values.rowwise().maxCoeff() - loads.values.rowwise().minCoeff())),
      most_per_Pa_(rules.scene().safety /
                   (rules.limit(0, {}).reversed_Pa * rules.least_mean_stress_factor())) {}

FatigueNode FatiguePlaces::worst_of(const std::vector<std::size_t>& nodes) const {
  std::vector<std::pair<double, std::size_t>> by_bound;
  for (const auto node : nodes) by_bound.emplace_back(most_amplitude_Pa(node), node);
  std::stable_sort(by_bound.begin(), by_bound.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  FatigueNode worst;
  for (const auto& [bound_Pa, node] : by_bound) {
    if (most_per_Pa_ * bound_Pa <= worst.utilisation) break;
    auto candidate = at(node, slack_of_search);
    if (candidate.utilisation > worst.utilisation) worst = candidate;
  }
  return nodes.empty() ? worst : at(worst.node);
}

/// Half of the difference of two stresses has at most the larger von Mises stress of both, and at most the
/// sum of the channels' own: exact zero where no channel changes.
double FatiguePlaces::most_amplitude_Pa(std::size_t node) const {
  const auto unit = unit_stresses_at(analysis_.responses, node);
  double of_channels_Pa = 0;
  for (Eigen::Index k = 0; k < unit.cols(); ++k)
    of_channels_Pa += half_ranges_[k] * von_mises_Pa(as_stress(unit.col(k)));
  return std::min(of_channels_Pa, largest_Pa_[node]);
}

FatigueNode FatiguePlaces::at(std::size_t node, double slack) const {
  FatigueNode result;
  result.node = node;
  result.cycle = largest_cycle(stress_history_Pa(analysis_.responses, loads_, node), slack);
  if (analysis_.method != Method::beam && result.cycle.amplitude_Pa > 0) {
    const Eigen::VectorXd half =
        0.5 * (loads_.values.col(result.cycle.to) - loads_.values.col(result.cycle.from)).matrix();
    result.gradient_per_m = slopes_.related_gradient_per_m(node, [&](std::size_t other) {
      return von_mises_Pa(as_stress(unit_stresses_at(analysis_.responses, other) * half));
    });
  }
  result.utilisation = rules_.limit(result.gradient_per_m, scalar(result.cycle)).utilisation;
  return result;
}

}  // namespace pipelines
