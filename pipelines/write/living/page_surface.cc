#include "pipelines/write/living/page_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pipelines {
namespace {

struct Mirror {
  int axis = -1;
  double place_m = 0, tolerance_m = 0;
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
  std::vector<std::size_t> doubled, others;  // faces above the plane, and those that are their own image
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    if (mirror.axis < 0) {
      others.push_back(f);
      continue;
    }
    const double side_m = middle_m(nodes, f, mirror.axis) - mirror.place_m;
    if (side_m > mirror.tolerance_m) doubled.push_back(f);
    if (std::abs(side_m) <= mirror.tolerance_m) others.push_back(f);
  }
  surface.n_doubled = doubled.size();
  doubled.insert(doubled.end(), others.begin(), others.end());

  // A node stands for itself and its image: that above the plane, or on it the one of the lower number.
  const auto stands_for = [&](std::int32_t node) {
    if (mirror.axis < 0) return node;
    const auto image = images.node[std::size_t(node)];
    const double side_m = nodes.xyz_m[3 * std::size_t(node) + std::size_t(mirror.axis)] - mirror.place_m;
    if (std::abs(side_m) <= mirror.tolerance_m) return std::min(node, image);
    return side_m > 0 ? node : image;
  };
  std::vector<char> is_kept(nodes.n, 0);
  for (const auto f : doubled)
    for (std::size_t i = 0; i < surface.nodes_per_face; ++i)
      is_kept[std::size_t(stands_for(shown.node(f, i)))] = 1;
  std::vector<std::uint32_t> position(nodes.n, 0);
  for (std::size_t node = 0; node < nodes.n; ++node)
    if (is_kept[node]) {
      position[node] = std::uint32_t(surface.nodes.size());
      surface.nodes.push_back(std::int32_t(node));
    }
  const auto n_kept = std::uint32_t(surface.nodes.size());
  for (const auto f : doubled)
    for (std::size_t i = 0; i < surface.nodes_per_face; ++i) {
      const auto node = shown.node(f, i);
      const auto kept = stands_for(node);
      surface.faces.push_back(position[std::size_t(kept)] + (kept == node ? 0 : n_kept));
    }
  return surface;
}

}  // namespace pipelines
