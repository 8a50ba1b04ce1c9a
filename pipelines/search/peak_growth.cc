#include "pipelines/search/peak_growth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pipelines/analysis/place_stress.h"
#include "pipelines/search/refinement.h"
#include "pipelines/superposition/zones.h"

namespace pipelines {
namespace {

/// In exclusion distances from an edge that is left out already: stress is steep there, and coarse cells find
/// more of it with every refinement, but at a fixed distance it converges.
constexpr double beside_edge = 2;

/// A single spot is left out for want of an edge: beside it stress may well grow.
bool is_spot(const meshes::SharpEdge& edge) {
  return edge.pieces.size() == 1 && edge.pieces.front()[0] == edge.pieces.front()[1];
}

bool beside_left_out_edge(const BodyAnalysis& analysis) {
  const auto& edges = analysis.mesh.sharp_edges;
  return std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return !is_spot(edge) && distance_m(analysis.peak.position_m, edge) < beside_edge * edge.distance_m;
  });
}

}  // namespace

bool PeakGrowth::at(const BodyAnalysis& analysis, double ratio) {
  if (!analysis.hot_spots.empty() || beside_left_out_edge(analysis)) return false;
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

namespace {

double diagonal_m(const fem::Nodes& nodes) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (std::size_t i = 0; i < nodes.n; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], nodes.xyz_m[3 * i + c]);
      high[c] = std::max(high[c], nodes.xyz_m[3 * i + c]);
    }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

/// Volume over surface, of the flat faces between the corners.
double thickness_m(const fem::Nodes& nodes) {
  using Vector = Eigen::Vector3d;
  const auto at = [&](std::int32_t node) {
    return Eigen::Map<const Vector>(&nodes.xyz_m[3 * std::size_t(node)]);
  };
  const auto n_corners = std::size_t(nodes.shape().n_face_corners());
  double volume = 0, area = 0;
  const Vector origin = at(0);
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    for (std::size_t half = 0; half + 2 < n_corners; ++half) {
      const auto face = nodes.face(f);
      const Vector a = at(face[0]);
      const Vector normal = (at(face[half + 1]) - a).cross(at(face[half + 2]) - a);
      area += normal.norm() / 2;
      volume += normal.dot(a - origin) / 6;
    }
  return volume / area;
}

}  // namespace

double left_out_around_edges_m(const fem::Nodes& nodes) {
  constexpr double share_of_diagonal = 0.01;
  return std::min(share_of_diagonal * diagonal_m(nodes), thickness_m(nodes));
}

}  // namespace pipelines
