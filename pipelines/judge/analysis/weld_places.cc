#include "pipelines/judge/analysis/weld_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/fatigue/weld_classes.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/estimates/hot_spots.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/judge/figures/stress_gradient.h"
#include "pipelines/superpose/between_instants/stress_course.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

}  // namespace

Eigen::ArrayXd WeldPlace::along_Pa(const Eigen::ArrayXXd& factors, double angle_rad) const {
  const Vector3d n = surface_normal.normalized();
  const Vector3d u = (across_toe - across_toe.dot(n) * n).normalized();
  const Vector3d d = std::cos(angle_rad) * u + std::sin(angle_rad) * n.cross(u);
  Eigen::Matrix<double, 1, 6> weights;
  weights << d.x() * d.x(), d.y() * d.y(), d.z() * d.z(), 2 * d.x() * d.y(), 2 * d.y() * d.z(),
      2 * d.x() * d.z();
  return (weights * unit_Pa * factors.matrix()).transpose().array();
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

ToeStress WeldPlace::stress(const FactorCourse& course) const {
  auto toe = stress(course.fine());
  toe.cycles.clear();
  const StressCourse stresses(unit_Pa, course);
  for (const auto& cycle : stresses.cycles_of(toe.form)) {
    const auto mean = [&](Index c) { return (cycle.from[std::size_t(c)] + cycle.to[std::size_t(c)]) / 2; };
    double mean_Pa = 0;
    for (Index c = 0; c < 6; ++c) mean_Pa += toe.form[c] * mean(c);
    toe.cycles.push_back({cycle.range_Pa, mean_Pa, 1});
  }
  return toe;
}

double WeldPlace::unresolved_share(const FactorCourse& course, const ToeStress& toe) const {
  const double range_Pa = toe.stress_Pa.maxCoeff() - toe.stress_Pa.minCoeff();
  if (course.is_resolved() || !(range_Pa > 0)) return 0;
  const auto& values = course.values();
  const Eigen::ArrayXd middle = (values.rowwise().maxCoeff() + values.rowwise().minCoeff()) / 2;
  std::vector<std::array<double, 6>> tensors(std::size_t(unit_Pa.cols()));
  for (Index k = 0; k < unit_Pa.cols(); ++k)
    std::copy_n(unit_Pa.col(k).data(), 6, tensors[std::size_t(k)].begin());
  const auto sampling = time_sampling(tensors, values.colwise() - middle);
  constexpr double most_principal = 1.1547;  // of von Mises in plane stress: 2 / sqrt(3)
  return most_principal * (course.is_polynomial() ? sampling.unresolved_Pa : sampling.error_Pa()) /
         (range_Pa / 2);
}

std::vector<WeldPlace> weld_places(const Judged& analysis) {
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
    place.detail = {rules.class_Pa, drawing->thickness_m, thickness_exponent_of(rules.type),
                    rules.partial_factor};
    place.type = rules.type;
    place.error_share = whole_error_share(analysis, spot);
    places.push_back(std::move(place));
  }
  return places;
}

}  // namespace pipelines
