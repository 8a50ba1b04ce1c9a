#include "pipelines/analysis/weld_places.h"

#include <algorithm>
#include <limits>

#include "pipelines/analysis/hot_spots.h"
#include "pipelines/analysis/place_stress.h"
#include "pipelines/analysis/stress_gradient.h"
#include "pipelines/common/errors.h"
#include "pipelines/common/name_lists.h"
#include "pipelines/common/nearest_name.h"
#include "pipelines/superposition/stress_shares.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

}  // namespace

double error_share_of(const BodyAnalysis& analysis, const std::string& feature) {
  for (const auto& place : analysis.place_stresses)
    if (place.feature == feature) return place.value_Pa > 0 ? place.error_Pa / place.value_Pa : 0;
  return std::numeric_limits<double>::infinity();
}

void require_toes(const BodyScene& body, const meshes::BodyMesh& mesh) {
  if (!body.fatigue) return;
  std::vector<std::string> names;
  for (const auto& spot : mesh.hot_spots) names.push_back(spot.name);
  for (const auto& [name, toe] : body.fatigue->toes_by_name)
    if (!contains(names, name))
      throw StageRefused(toe.origin + ": \"" + name + "\" is no weld toe of this body; write one of " +
                         listed(names));
}

std::vector<WeldPlace> weld_places(const BodyAnalysis& analysis) {
  if (analysis.hot_spots.empty()) return {};
  const auto& scene = analysis.scene.fatigue.value();
  const SurfaceSlopes surface(analysis.responses.nodes);
  std::vector<WeldPlace> places;
  for (const auto& spot : analysis.hot_spots) {
    const auto drawing = std::find_if(analysis.mesh.hot_spots.begin(), analysis.mesh.hot_spots.end(),
                                      [&](const auto& drawn) { return drawn.name == spot.name; });
    if (drawing == analysis.mesh.hot_spots.end()) continue;
    const auto own = scene.toes_by_name.find(spot.name);
    const auto& rules = own != scene.toes_by_name.end() ? own->second : scene.toes;
    const auto unit = unit_stress_at(analysis.responses, stress_point(spot));
    const auto normal = surface.outward_normal(spot.near_node);
    WeldPlace place;
    place.name = spot.name;
    place.toe_m = spot.toe_m;
    place.unit_Pa = Eigen::Map<const Eigen::MatrixXd>(unit.front().data(), 6, Index(unit.size()));
    place.surface_normal = Eigen::Map<const Vector3d>(normal.data());
    place.across_toe = Eigen::Map<const Vector3d>(drawing->near_m.data()) -
                       Eigen::Map<const Vector3d>(drawing->toe_m.data());
    place.detail = {rules.class_Pa, drawing->thickness_m, WeldDetail().thickness_exponent,
                    rules.partial_factor};
    place.error_share = error_share_of(analysis, spot.name);
    places.push_back(std::move(place));
  }
  return places;
}

}  // namespace pipelines
