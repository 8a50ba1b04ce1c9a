#include "pipelines/write/living/page_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pipelines {
namespace {

struct Mirror {
  int axis = -1;  ///< -1: none
  double place_m = 0, tolerance_m = 0;

  /// 1 above the plane, -1 below it, 0 on it.
  int side(double at_m) const {
    const double above_m = at_m - place_m;
    return std::abs(above_m) <= tolerance_m ? 0 : above_m > 0 ? 1 : -1;
  }
};

/// The plane between a node and its image, if their images are all that the page needs to show a half.
Mirror mirror_of(const fem::Nodes& nodes, const std::vector<std::int32_t>& image) {
  Mirror mirror;
  double widest_m = 0;
  for (std::size_t i = 0; i < image.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      const double other_m = nodes.xyz_m[3 * std::size_t(image[i]) + d], own_m = nodes.xyz_m[3 * i + d];
      if (std::abs(other_m - own_m) <= widest_m) continue;
      widest_m = std::abs(other_m - own_m);
      mirror.axis = int(d);
      mirror.place_m = (other_m + own_m) / 2;
    }
  mirror.tolerance_m = 1e-9 * widest_m;
  return mirror;
}

/// The faces that are shown, by nodes of the body.
class ShownFaces {
public:
  ShownFaces(const fem::Nodes& nodes, std::size_t most_nodes) : nodes_(nodes), kept_(nodes.nodes_per_face()) {
    std::vector<std::int32_t> all = nodes.faces;
    std::sort(all.begin(), all.end());
    n_nodes_ = std::size_t(std::unique(all.begin(), all.end()) - all.begin());
    const std::size_t corners = nodes.kind == fem::CellKind::hexahedra ? 4 : 3;
    const bool is_known = kept_ == corners || kept_ == 6 || kept_ == 9;
    if (n_nodes_ > most_nodes || !is_known) kept_ = corners;
  }

  std::size_t nodes_per_face() const { return kept_; }
  bool has_corners_only() const { return kept_ < nodes_.nodes_per_face(); }
  std::int32_t node(std::size_t face, std::size_t i) const { return nodes_.face(face)[i]; }

private:
  const fem::Nodes& nodes_;
  std::size_t kept_, n_nodes_ = 0;
};

/// Mean place of a face along an axis.
double middle_m(const fem::Nodes& nodes, std::size_t face, int axis) {
  double sum_m = 0;
  for (const auto node : nodes.face(face)) sum_m += nodes.xyz_m[3 * std::size_t(node) + std::size_t(axis)];
  return sum_m / double(nodes.nodes_per_face());
}

/// Faces in the order in which the page has them: those above the mirror's plane, whose images are not
/// listed, then those that are their own image; without a mirror all.
/// @param n_doubled  takes the number of the first
std::vector<std::size_t> listed_faces(const fem::Nodes& nodes, const Mirror& mirror, std::size_t& n_doubled) {
  std::vector<std::size_t> doubled, others;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const int side = mirror.axis < 0 ? 0 : mirror.side(middle_m(nodes, f, mirror.axis));
    if (side >= 0) (side > 0 ? doubled : others).push_back(f);
  }
  n_doubled = doubled.size();
  doubled.insert(doubled.end(), others.begin(), others.end());
  return doubled;
}

/// The node that stands for a node and its image: that above the plane, or on it the one of the lower number.
std::int32_t kept_of_pair(std::int32_t node, const fem::Nodes& nodes, const std::vector<std::int32_t>& image,
                          const Mirror& mirror) {
  if (mirror.axis < 0) return node;
  const auto other = image[std::size_t(node)];
  const int side = mirror.side(nodes.xyz_m[3 * std::size_t(node) + std::size_t(mirror.axis)]);
  return side == 0 ? std::min(node, other) : side > 0 ? node : other;
}

/// Enters the nodes of corners, each once and ascending.
/// @return their positions, by node of the body
std::vector<std::uint32_t> enter_nodes(const std::vector<std::int32_t>& corners, std::size_t n,
                                       PageSurface& surface) {
  std::vector<char> is_kept(n, 0);
  for (const auto node : corners) is_kept[std::size_t(node)] = 1;
  std::vector<std::uint32_t> position(n, 0);
  for (std::size_t node = 0; node < n; ++node) {
    if (!is_kept[node]) continue;
    position[node] = std::uint32_t(surface.nodes.size());
    surface.nodes.push_back(std::int32_t(node));
  }
  return position;
}

}  // namespace

PageSurface page_surface(const fem::Nodes& nodes, const fem::MirrorImages& images, std::size_t most_nodes) {
  PageSurface surface;
  if (nodes.faces.empty()) return surface;
  const bool has_image = !images.node.empty();
  const ShownFaces shown(nodes, has_image ? 2 * most_nodes : most_nodes);
  surface.nodes_per_face = shown.nodes_per_face();
  surface.has_corners_only = shown.has_corners_only();
  const auto mirror = has_image ? mirror_of(nodes, images.node) : Mirror();
  surface.mirror_axis = mirror.axis;
  surface.mirror_at_m = mirror.place_m;
  std::vector<std::int32_t> corners, kept;
  for (const auto f : listed_faces(nodes, mirror, surface.n_doubled))
    for (std::size_t i = 0; i < surface.nodes_per_face; ++i) {
      corners.push_back(shown.node(f, i));
      kept.push_back(kept_of_pair(corners.back(), nodes, images.node, mirror));
    }
  const auto position = enter_nodes(kept, nodes.n, surface);
  const auto n_kept = std::uint32_t(surface.nodes.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
    surface.faces.push_back(position[std::size_t(kept[i])] + (kept[i] == corners[i] ? 0 : n_kept));
  return surface;
}

}  // namespace pipelines
