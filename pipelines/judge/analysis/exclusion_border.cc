#include "pipelines/judge/analysis/exclusion_border.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {
namespace {

using NodeSpan = decltype(std::declval<const fem::Nodes&>().face(0));

class Border {
public:
  Border(const StressBesideEdges& body, double largest_Pa) : body_(body), largest_Pa_(largest_Pa) {}

  /// @param boundary_id  whose own distances count; none: inside the body
  void look_at(const NodeSpan& nodes, std::optional<int> boundary_id) {
    const auto& excluded = body_.places.excluded;
    const auto is_within = [&](auto node) { return excluded[std::size_t(node)] != 0; };
    if (std::none_of(nodes.begin(), nodes.end(), is_within)) return;
    std::vector<std::size_t> within, outside;
    for (const auto i : nodes) (is_within(i) ? within : outside).push_back(std::size_t(i));
    for (const auto node : outside) {
      const auto next = nearest(node, within);
      if (nearest(next, outside) == node)
        largest_Pa_ = std::max(largest_Pa_, on_border_Pa(node, next, boundary_id));
    }
  }

  double largest_Pa() const { return largest_Pa_; }

private:
  std::array<double, 3> point_m(std::size_t node) const {
    const double* x = &body_.nodes.xyz_m[3 * node];
    return {x[0], x[1], x[2]};
  }

  /// The first of the nearest ones of some nodes, not none.
  std::size_t nearest(std::size_t node, const std::vector<std::size_t>& others) const {
    const auto distance_from = [&, at_m = point_m(node)](std::size_t other) {
      const auto to_m = point_m(other);
      return std::hypot(to_m[0] - at_m[0], to_m[1] - at_m[1], to_m[2] - at_m[2]);
    };
    return *std::min_element(others.begin(), others.end(), [&](std::size_t a, std::size_t b) {
      return distance_from(a) < distance_from(b);
    });
  }

  double on_border_Pa(std::size_t outside, std::size_t within, std::optional<int> boundary_id) const {
    const auto& stress_Pa = body_.von_mises_Pa;
    const double rise_Pa = stress_Pa[within] - stress_Pa[outside];
    if (!(rise_Pa > 0) || stress_Pa[within] <= largest_Pa_) return stress_Pa[outside];
    const double from_m = std::max(0.0, beyond_m(outside, boundary_id)),
                 to_m = std::min(0.0, beyond_m(within, boundary_id));
    const double share = from_m > to_m ? from_m / (from_m - to_m) : 0;
    return stress_Pa[outside] + share * rise_Pa;
  }

  double beyond_m(std::size_t node, std::optional<int> boundary_id) const {
    return beyond_border_m(body_.mesh, point_m(node), boundary_id);
  }

  const StressBesideEdges& body_;
  double largest_Pa_;
};

constexpr double beside = 1.5;  // of the exclusion distance

/// The largest exclusion distance of the sharp edges beside a point; 0: none is near.
double left_out_beside_m(const meshes::BodyMesh& mesh, const std::array<double, 3>& point_m) {
  double left_out_m = 0;
  for (const auto& edge : mesh.sharp_edges)
    if (distance_m(point_m, edge) < beside * edge.distance_m)
      left_out_m = std::max(left_out_m, edge.distance_m);
  return left_out_m;
}

/// The longest extent of the faces at a node, in a half plane through the axis.
double longest_face_m(const fem::Nodes& nodes, std::size_t node) {
  double longest_m = 0;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    if (std::find(face.begin(), face.end(), std::int32_t(node)) == face.end()) continue;
    const auto extent_m = [&](const auto& coordinate) {
      const auto [least, most] = std::minmax_element(
          face.begin(), face.end(), [&](auto a, auto b) { return coordinate(a) < coordinate(b); });
      return coordinate(*most) - coordinate(*least);
    };
    const auto at = [&](auto i) { return &nodes.xyz_m[3 * std::size_t(i)]; };
    longest_m = std::max({longest_m, extent_m([&](auto i) { return at(i)[2]; }),
                          extent_m([&](auto i) { return std::hypot(at(i)[0], at(i)[1]); })});
  }
  return longest_m;
}

bool is_of(const meshes::SharpEdge& edge, const std::string& face) {
  return ("/" + edge.name + "/").find("/" + face + "/") != std::string::npos;
}

/// The edge whose border is nearest to a point; null: there are none.
/// @param face  that the point is on: one of its edges, if the point is beside it; another one may leave out
///              more, and end there
const meshes::SharpEdge* nearest_border(const std::vector<meshes::SharpEdge>& edges,
                                        const std::array<double, 3>& at_m, const std::string& face) {
  const auto rank = [&](const meshes::SharpEdge& edge) {
    const double away_m = distance_m(at_m, edge);
    return std::pair(!(is_of(edge, face) && away_m < beside * edge.distance_m), away_m - edge.distance_m);
  };
  const auto nearest = std::min_element(edges.begin(), edges.end(),
                                        [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return nearest == edges.end() ? nullptr : &*nearest;
}

/// The longest edge of the faces at a node.
double longest_edge_m(const fem::Nodes& nodes, std::size_t node) {
  double longest_m = 0;
  const auto n_corners = std::size_t(nodes.shape().n_face_corners());
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    if (std::find(face.begin(), face.end(), std::int32_t(node)) == face.end()) continue;
    for (std::size_t i = 0; i < n_corners; ++i) {
      const double *a = &nodes.xyz_m[3 * std::size_t(face[i])],
                   *b = &nodes.xyz_m[3 * std::size_t(face[(i + 1) % n_corners])];
      longest_m = std::max(longest_m, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
  }
  return longest_m;
}

}  // namespace

double beyond_border_m(const meshes::BodyMesh& mesh, const std::array<double, 3>& point_m,
                       std::optional<int> boundary_id) {
  double least_m = std::numeric_limits<double>::max();
  for (const auto& edge : mesh.sharp_edges) {
    double border_m = edge.distance_m;
    if (boundary_id)
      if (const auto own = edge.distance_on_m.find(*boundary_id); own != edge.distance_on_m.end())
        border_m = std::max(border_m, own->second);
    least_m = std::min(least_m, distance_m(point_m, edge) - border_m);
  }
  return least_m;
}

double rise_to_border_Pa(const StressBesideEdges& body, const PlaceStress& place) {
  if (body.mesh.sharp_edges.empty()) return 0;
  const auto& nodes = body.nodes;
  Border border(body, place.value_Pa);
  if (place.feature == inside_the_body)
    for (std::size_t c = 0; c < nodes.n_cells(); ++c) border.look_at(nodes.cell(c), std::nullopt);
  for (const auto& feature : body.mesh.features)
    if (feature.name == place.feature)
      for (std::size_t f = 0; f < nodes.n_faces(); ++f)
        if (nodes.face_boundary_id[f] == feature.boundary_id)
          border.look_at(nodes.face(f), feature.boundary_id);
  return border.largest_Pa() - place.value_Pa;
}

double rise_to_border_Pa(const Superposed& analysis, const PlaceStress& place) {
  return rise_to_border_Pa(
      {analysis.responses.nodes, analysis.envelope.von_mises.value_Pa, analysis.places, analysis.mesh},
      place);
}

double largest_at_border_Pa(const Superposed& analysis) {
  const auto& nodes = analysis.responses.nodes;
  const StressBesideEdges body{nodes, analysis.envelope.von_mises.value_Pa, analysis.places, analysis.mesh};
  Border border(body, 0);
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) border.look_at(nodes.face(f), nodes.face_boundary_id[f]);
  return border.largest_Pa();
}

const meshes::SharpEdge* edge_beside_peak(const Judged& analysis) {
  const auto* nearest =
      nearest_border(analysis.mesh.sharp_edges, analysis.peak.position_m, analysis.peak.feature);
  if (nearest == nullptr) return nullptr;
  if (distance_m(analysis.peak.position_m, *nearest) < beside * nearest->distance_m) return nearest;
  const auto& nodes = analysis.responses.nodes;
  // Where tetrahedra are larger than what is left out, the peak may lie in the middle of one that reaches to
  // the edge.
  const bool of_tetrahedra = nodes.shape().is_tetrahedron();
  const auto rises_to = [&](std::int32_t node) {
    return analysis.places.excluded[std::size_t(node)] != 0 &&
           (of_tetrahedra ||
            analysis.envelope.von_mises.value_Pa[std::size_t(node)] > analysis.peak.value_Pa);
  };
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    if (std::find(face.begin(), face.end(), std::int32_t(analysis.peak.node)) != face.end() &&
        std::any_of(face.begin(), face.end(), rises_to))
      return nearest;
  }
  return nullptr;
}

bool is_at_border(const meshes::BodyMesh& mesh, const std::array<double, 3>& point_m) {
  return left_out_beside_m(mesh, point_m) > 0;
}

namespace {

/// Tetrahedra may be larger than what is left out: those count that reach from the place to within.
double tetrahedra_to_border(const Superposed& analysis, const PlaceStress& place) {
  const auto& nodes = analysis.responses.nodes;
  const auto* edge = nearest_border(analysis.mesh.sharp_edges, place.position_m, place.feature);
  if (edge == nullptr) return 0;
  const auto is_excluded = [&](std::int32_t i) { return analysis.places.excluded[std::size_t(i)] != 0; };
  bool is_beside = distance_m(place.position_m, *edge) < beside * edge->distance_m;
  for (std::size_t f = 0; f < nodes.n_faces() && !is_beside; ++f) {
    const auto face = nodes.face(f);
    is_beside = std::find(face.begin(), face.end(), std::int32_t(place.node)) != face.end() &&
                std::any_of(face.begin(), face.end(), is_excluded);
  }
  return is_beside ? edge->distance_m / longest_edge_m(nodes, place.node) : 0;
}

}  // namespace

double cells_to_border(const Superposed& analysis, const PlaceStress& place) {
  if (analysis.responses.nodes.shape().is_tetrahedron()) return tetrahedra_to_border(analysis, place);
  const double left_out_m = left_out_beside_m(analysis.mesh, place.position_m);
  const double face_m = left_out_m > 0 ? longest_face_m(analysis.responses.nodes, place.node) : 0;
  return face_m > 0 ? left_out_m / face_m : 0;
}

}  // namespace pipelines
