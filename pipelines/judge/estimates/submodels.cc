#include "pipelines/judge/estimates/submodels.h"

#include <algorithm>
#include <cmath>

#include "fem/refine/submodel/submodel.h"
#include "pipelines/judge/estimates/fitted.h"

namespace pipelines {
namespace {

constexpr fem::SubmodelControl coarser{2, 1}, finest{2, 2}, wider{3, 1};

fem::SubmodelControl under_load(fem::SubmodelControl control) {
  control.loaded_faces = fem::LoadedFaces::loaded;
  return control;
}

std::vector<fem::WeightedNode> nodes_of(const StressPoint& point) {
  std::vector<fem::WeightedNode> nodes;
  for (const auto& part : point.parts) nodes.push_back({part.node, part.weight});
  return nodes;
}

}  // namespace

double submodel_error_Pa(const StressPoint& point, const fem::UnitResponses& responses, const fem::Body& body,
                         const BodyLoads& loads, const fem::LeftOut& left_out) {
  const Eigen::ArrayXd column = loads.history.values.col(point.instant);
  const std::vector<double> factors(column.begin(), column.end());
  const double value_Pa = von_mises_of(unit_stress_at(responses, point), column);
  const auto largest_Pa = [&](const fem::SubmodelControl& control) {
    return fem::submodel_stress(responses, body, loads.unit_loads, nodes_of(point), factors, left_out,
                                control)
        .largest_Pa;
  };
  const double coarser_Pa = largest_Pa(under_load(coarser)), finest_Pa = largest_Pa(under_load(finest)),
               wider_Pa = largest_Pa(under_load(wider));
  return 1.5 * std::abs(finest_Pa - value_Pa) + std::abs(finest_Pa - coarser_Pa) +
         std::abs(wider_Pa - coarser_Pa);
}

namespace {

/// The item of that name; null: there is none.
template <typename Spot>
const Spot* find(const std::vector<Spot>& spots, const std::string& name) {
  const auto found = std::find_if(spots.begin(), spots.end(), [&](const Spot& s) { return s.name == name; });
  return found == spots.end() ? nullptr : &*found;
}

void resolve(const meshes::HotSpot& drawn, const fem::UnitResponses& responses, const fem::Body& body,
             const BodyLoads& loads, HotSpotStress& spot) {
  const auto nodes = nodes_of(stress_point(spot));
  auto resolved = std::make_shared<ResolvedStress>();
  resolved->unit_Pa = fem::submodel_unit_stress_Pa(responses, body, loads.unit_loads, nodes, finest);
  take_course(drawn, resolved->unit_Pa, loads.history, spot);
  const Eigen::ArrayXd column = loads.history.values.col(spot.instant);
  const std::vector<double> factors(column.begin(), column.end());
  const auto stress_Pa = [&](const fem::SubmodelControl& control) {
    return fem::submodel_stress(responses, body, loads.unit_loads, nodes, factors, {}, control).at_point_Pa;
  };
  const double coarser_Pa = stress_Pa(coarser), wider_Pa = stress_Pa(wider);
  const double error_Pa =
      1.5 * std::abs(spot.von_mises_Pa - coarser_Pa) + 2 * std::abs(wider_Pa - coarser_Pa);
  resolved->error_share = spot.von_mises_Pa > 0 ? error_Pa / spot.von_mises_Pa : 0;
  spot.resolved = std::move(resolved);
}

}  // namespace

void resolve_hot_spots(const std::vector<meshes::HotSpot>& of_mesh, const fem::UnitResponses& responses,
                       const fem::Body& body, const BodyLoads& loads, std::vector<HotSpotStress>& spots,
                       const std::vector<HotSpotStress>& known) {
  double largest_Pa = 0;      // largest stress of the toes that are resolved
  for (auto& spot : spots) {  // in descending order: the first that cannot lead ends it
    if (spot.von_mises_Pa * (1 + fitted::largest_error_of_toes) < largest_Pa) break;
    if (fem::is_on_load(responses, body, loads.unit_loads, nodes_of(stress_point(spot)))) continue;
    const auto& drawn = *find(of_mesh, spot.name);
    if (const auto* before = find(known, spot.name); before != nullptr && before->resolved) {
      spot.resolved = before->resolved;
      take_course(drawn, spot.resolved->unit_Pa, loads.history, spot);
    } else {
      resolve(drawn, responses, body, loads, spot);
    }
    largest_Pa = std::max(largest_Pa, spot.von_mises_Pa);
  }
  sort_by_stress(spots);
}

}  // namespace pipelines
