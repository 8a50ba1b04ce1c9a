#include "pipelines/analysis/submodels.h"

#include <algorithm>
#include <cmath>

#include "fem/submodel/submodel.h"

namespace pipelines {
namespace {

constexpr fem::SubmodelControl coarser{2, 1}, finest{2, 2}, wider{3, 1};

std::vector<fem::WeightedNode> nodes_of(const StressPoint& point) {
  std::vector<fem::WeightedNode> nodes;
  for (const auto& part : point.parts) nodes.push_back({part.node, part.weight});
  return nodes;
}

}  // namespace

double submodel_error_Pa(const StressPoint& point, const fem::UnitResponses& responses, const fem::Body& body,
                         const BodyLoads& loads, const std::vector<char>& left_out) {
  const Eigen::ArrayXd column = loads.history.values.col(point.instant);
  const std::vector<double> factors(column.begin(), column.end());
  const double value_Pa = von_mises_of(unit_stress_at(responses, point), column);
  const auto largest_Pa = [&](const fem::SubmodelControl& control) {
    return fem::submodel_stress(responses, body, loads.unit_loads, nodes_of(point), factors, left_out,
                                control)
        .largest_Pa;
  };
  const double coarser_Pa = largest_Pa(coarser), finest_Pa = largest_Pa(finest), wider_Pa = largest_Pa(wider);
  return 1.5 * std::abs(finest_Pa - value_Pa) + std::abs(finest_Pa - coarser_Pa) +
         std::abs(wider_Pa - coarser_Pa);
}

ErrorEntry resolved_estimate(const StressPoint& point, const Eigen::ArrayXd& factors) {
  const auto& resolved = *point.resolved;
  const double finest_Pa = von_mises_of(resolved.finest_Pa, factors),
               coarser_Pa = von_mises_of(resolved.coarser_Pa, factors),
               wider_Pa = von_mises_of(resolved.wider_Pa, factors);
  return {"discretisation", submodel_method,
          1.5 * std::abs(finest_Pa - coarser_Pa) + 2 * std::abs(wider_Pa - coarser_Pa), 1};
}

void resolve_hot_spots(const std::vector<meshes::HotSpot>& of_mesh, const fem::UnitResponses& responses,
                       const fem::Body& body, const BodyLoads& loads, std::vector<HotSpotStress>& spots) {
  double largest_Pa = 0;      // of those that are resolved
  for (auto& spot : spots) {  // in descending order: the first that cannot lead ends it
    if (spot.von_mises_Pa * (1 + largest_error_of_toes) < largest_Pa) break;
    const auto nodes = nodes_of(stress_point(spot));
    const auto unit = [&](const fem::SubmodelControl& control) {
      return fem::submodel_unit_stress_Pa(responses, body, loads.unit_loads, nodes, control);
    };
    auto stress = std::make_shared<ResolvedStress>();
    stress->coarser_Pa = unit(coarser);
    stress->finest_Pa = unit(finest);
    stress->wider_Pa = unit(wider);
    spot.resolved = std::move(stress);
    const auto drawn = std::find_if(of_mesh.begin(), of_mesh.end(), [&](const meshes::HotSpot& drawing) {
      return drawing.name == spot.name;
    });
    take_course(*drawn, spot.resolved->finest_Pa, loads.history, spot);
    largest_Pa = std::max(largest_Pa, spot.von_mises_Pa);
  }
  sort_by_stress(spots);
}

}  // namespace pipelines
