#include "pipelines/search/refinement/peak_growth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "meshes/checks/reentrant_edges.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/search/refinement/refinement.h"
#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {
namespace {

/// In exclusion distances from an edge that is left out already: stress is steep there, and coarse cells find
/// more of it with every refinement, but at a fixed distance it converges.
constexpr double beside_edge = 2;

bool beside_left_out_edge(const Judged& analysis) {
  const auto& edges = analysis.mesh.sharp_edges;
  return std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return distance_m(analysis.peak.position_m, edge) < beside_edge * edge.distance_m;
  });
}

/// A circle rounds a fillet off: its stress has a bound, however long coarse cells keep finding more of it.
bool is_on_fillet(const Judged& analysis) {
  const auto& features = analysis.mesh.features;
  return std::any_of(features.begin(), features.end(), [&](const auto& feature) {
    return feature.name == analysis.peak.feature && feature.kind == meshes::Feature::Kind::fillet;
  });
}

}  // namespace

bool PeakGrowth::at(const Judged& analysis, double ratio) {
  if (!analysis.hot_spots.empty() || is_on_fillet(analysis) || beside_left_out_edge(analysis)) return false;
  std::map<std::string, double> now{{analysis.peak.feature, analysis.peak.value_Pa}};
  if (analysis.responses.nodes.shape().is_tetrahedron())
    for (const auto& place :
         largest_by_feature(analysis.responses.nodes, analysis.envelope.von_mises.value_Pa,
                            analysis.mesh.features, analysis.places))
      now.emplace(place.feature, place.value_Pa);
  std::map<std::string, Course> known;
  known.swap(courses_);
  for (const auto& [feature, value_Pa] : now) {
    Course course = known[feature];
    if (!course.values.empty()) course.ratios.push_back(ratio);
    course.values.push_back(value_Pa);
    courses_[feature] = course;
  }
  const auto& course = courses_.at(analysis.peak.feature);
  const bool grows = grows_without_bound(course.values, course.ratios);
  if (grows) courses_.clear();
  return grows;
}

double left_out_around_edges_m(const fem::Nodes& nodes) {
  const auto at = [&](std::int32_t node) {
    const double* x = &nodes.xyz_m[3 * std::size_t(node)];
    return meshes::Point{x[0], x[1], x[2]};
  };
  const auto n_corners = std::size_t(nodes.shape().n_face_corners());
  std::vector<std::array<meshes::Point, 3>> surface;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    for (std::size_t half = 0; half + 2 < n_corners; ++half) {
      const auto face = nodes.face(f);
      surface.push_back({at(face[0]), at(face[half + 1]), at(face[half + 2])});
    }
  return meshes::usual_exclusion_m(meshes::size_within(surface));
}

}  // namespace pipelines
