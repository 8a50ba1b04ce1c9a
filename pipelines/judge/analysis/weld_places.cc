#include "pipelines/judge/analysis/weld_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/fatigue/weld_classes.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/analysis/load_patch.h"
#include "pipelines/judge/estimates/hot_spots.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/judge/figures/stress_gradient.h"
#include "pipelines/superpose/between_instants/stress_course.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

void take_unit_stress(const Responded& analysis, const StressPoint& point, WeldPlace& place) {
  const auto unit = unit_stress_at(analysis.responses, point);
  place.unit_Pa = Eigen::Map<const Eigen::MatrixXd>(unit.front().data(), 6, Index(unit.size()));
}

/// Direction of a notch's edge beside a point.
Vector3d along_notch(const meshes::EffectiveNotch& notch, const Vector3d& at_m) {
  const auto point = [&](std::size_t i) { return Eigen::Map<const Vector3d>(notch.course_m[i].data()); };
  double least_m = std::numeric_limits<double>::max();
  Vector3d along = Vector3d::Zero();
  for (std::size_t i = 0; i + 1 < notch.course_m.size(); ++i) {
    const double away_m = ((point(i) + point(i + 1)) / 2 - at_m).norm();
    if (away_m >= least_m || (point(i + 1) - point(i)).norm() == 0) continue;
    least_m = away_m;
    along = (point(i + 1) - point(i)).normalized();
  }
  return along;
}

/// The largest range over the cycle of the normal stress in the surface, across a weld or turned by 30 and 60
/// degrees from that.
double range_Pa(const WeldPlace& place, const Eigen::ArrayXXd& factors) {
  double largest_Pa = 0;
  for (const double angle : {-60, -30, 0, 30, 60}) {
    const auto stress_Pa = place.along_Pa(factors, angle * pi / 180);
    largest_Pa = std::max(largest_Pa, stress_Pa.maxCoeff() - stress_Pa.minCoeff());
  }
  return largest_Pa;
}

/// Whole error of the stress on a notch, as a share of it: the place's, load patches, other assumptions.
double error_share_of_notch(const Judged& analysis, const std::string& feature, std::size_t node) {
  for (const auto& place : analysis.place_stresses) {
    if (place.feature != feature) continue;
    if (!(place.value_Pa > 0)) return 0;
    const double patches_Pa =
        load_patch_error_Pa(analysis, {{{place.node, 1.0}}, 0}, analysis.loads.history.values);
    return std::max(stated_error_share(analysis, feature),
                    (error_Pa(analysis, place) + patches_Pa) / place.value_Pa +
                        model_error_share(analysis, feature, node));
  }
  return std::numeric_limits<double>::infinity();
}

/// The node of a notch whose stress across the weld changes most.
std::optional<WeldPlace> place_of_notch(const Judged& analysis, const SurfaceSlopes& surface,
                                        const meshes::EffectiveNotch& notch, const std::string& feature) {
  const auto& nodes = analysis.responses.nodes;
  std::set<std::size_t> on_notch;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    if (nodes.face_boundary_id[f] == notch.boundary_id)
      on_notch.insert(nodes.face(f).begin(), nodes.face(f).end());
  std::optional<WeldPlace> worst;
  double largest_Pa = -1;
  std::size_t worst_node = 0;
  for (const auto node : on_notch) {
    if (analysis.places.excluded[node] != 0) continue;
    const auto normal = surface.outward_normal(node);
    WeldPlace place;
    place.name = feature;
    std::copy_n(&nodes.xyz_m[3 * node], 3, place.toe_m.begin());
    place.surface_normal = Eigen::Map<const Vector3d>(normal.data());
    place.across_toe =
        along_notch(notch, Eigen::Map<const Vector3d>(place.toe_m.data())).cross(place.surface_normal);
    take_unit_stress(analysis, {{{node, 1.0}}, 0}, place);
    if (const double its_Pa = range_Pa(place, analysis.loads.history.values); its_Pa > largest_Pa) {
      largest_Pa = its_Pa;
      worst_node = node;
      worst = std::move(place);
    }
  }
  if (worst) worst->error_share = error_share_of_notch(analysis, feature, worst_node);
  return worst;
}

void add_notches(const Judged& analysis, const SurfaceSlopes& surface, std::vector<WeldPlace>& places) {
  for (const auto& notch : analysis.mesh.notches)
    for (const auto& feature : analysis.mesh.features) {
      if (feature.boundary_id != notch.boundary_id) continue;
      auto place = place_of_notch(analysis, surface, notch, feature.name);
      if (!place) continue;
      place->type = effective_notch;
      place->detail.fat_Pa = fat_of_notch_Pa(notch.radius_m);
      place->detail.thickness_exponent = 0;
      place->detail.gamma_M = analysis.scene.fatigue->toes.partial_factor;
      places.push_back(std::move(*place));
    }
}

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
  if (analysis.hot_spots.empty() && analysis.mesh.notches.empty()) return {};
  const auto& scene = analysis.scene.fatigue.value();
  const SurfaceSlopes surface(analysis.responses.nodes);
  std::vector<WeldPlace> places;
  for (const auto& spot : analysis.hot_spots) {
    const auto drawing = std::find_if(analysis.mesh.hot_spots.begin(), analysis.mesh.hot_spots.end(),
                                      [&](const auto& drawn) { return drawn.name == spot.name; });
    if (drawing == analysis.mesh.hot_spots.end()) continue;
    const auto own = scene.toes_by_name.find(spot.name);
    const auto& rules = own != scene.toes_by_name.end() ? own->second : scene.toes;
    const auto normal = surface.outward_normal(spot.near_node);
    WeldPlace place;
    place.name = spot.name;
    place.toe_m = spot.toe_m;
    take_unit_stress(analysis, stress_point(spot), place);
    place.surface_normal = Eigen::Map<const Vector3d>(normal.data());
    place.across_toe = Eigen::Map<const Vector3d>(drawing->near_m.data()) -
                       Eigen::Map<const Vector3d>(drawing->toe_m.data());
    place.detail = {rules.class_Pa, drawing->thickness_m, thickness_exponent_of(rules.type),
                    rules.partial_factor};
    place.type = rules.type;
    place.error_share = whole_error_share(analysis, spot);
    places.push_back(std::move(place));
  }
  add_notches(analysis, surface, places);
  return places;
}

}  // namespace pipelines
