#include "fem/mesh/grid/mirror_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace fem {

namespace {

using Point = std::array<double, 3>;

struct Box {
  Point low, high;

  double size_m() const { return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]); }
};

Box box_around(const Grid& grid) {
  constexpr double far_m = std::numeric_limits<double>::max();
  Box box{{far_m, far_m, far_m}, {-far_m, -far_m, -far_m}};
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      const double x = grid.xyz_m[3 * i + d];
      box.low[d] = std::min(box.low[d], x);
      box.high[d] = std::max(box.high[d], x);
    }
  return box;
}

/// Finds the node at a point: nodes by their place along an oblique line, where hardly two of them meet.
class NodesByPlace {
public:
  NodesByPlace(const Grid& grid, double tolerance_m) : grid_(grid), tolerance_m_(tolerance_m) {
    for (std::size_t i = 0; i < grid.n_nodes; ++i)
      nodes_.emplace_back(along(grid.position(std::int32_t(i))), std::int32_t(i));
    std::sort(nodes_.begin(), nodes_.end());
  }

  /// @return -1 where there is none
  std::int32_t at(const Point& x_m) const {
    const double place_m = along(x_m.data()),
                 reach_m = 2 * tolerance_m_;  // the direction's components sum to 1.7
    auto near = std::lower_bound(nodes_.begin(), nodes_.end(), std::pair(place_m - reach_m, 0));
    for (; near != nodes_.end() && near->first <= place_m + reach_m; ++near) {
      const double* own = grid_.position(near->second);
      double distance_m = 0;
      for (std::size_t d = 0; d < 3; ++d) distance_m = std::max(distance_m, std::abs(own[d] - x_m[d]));
      if (distance_m <= tolerance_m_) return near->second;
    }
    return -1;
  }

private:
  static double along(const double* x_m) { return 0.7321 * x_m[0] + 0.5197 * x_m[1] + 0.4404 * x_m[2]; }

  const Grid& grid_;
  double tolerance_m_;
  std::vector<std::pair<double, std::int32_t>> nodes_;
};

/// No mesh has an image whose nodes do not balance about the plane: this rules out most.
bool balances(const Grid& grid, int axis, double place_m, double tolerance_m) {
  double sum_m = 0;
  for (std::size_t i = 0; i < grid.n_nodes; ++i) sum_m += grid.xyz_m[3 * i + std::size_t(axis)] - place_m;
  return std::abs(sum_m) <= tolerance_m * double(grid.n_nodes);
}

bool images_of_nodes(const Grid& grid, const NodesByPlace& nodes, MirrorPlane& plane) {
  const auto axis = std::size_t(plane.axis);
  plane.node.assign(grid.n_nodes, -1);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    if (plane.node[i] >= 0) continue;
    Point image{grid.xyz_m[3 * i], grid.xyz_m[3 * i + 1], grid.xyz_m[3 * i + 2]};
    image[axis] = 2 * plane.place_m - image[axis];
    const auto found = nodes.at(image);
    if (found < 0 || (plane.node[std::size_t(found)] >= 0)) return false;
    plane.node[i] = found;
    plane.node[std::size_t(found)] = std::int32_t(i);
  }
  return true;
}

bool images_of_cells(const Grid& grid, const CellsOfNodes& cells, double tolerance_m, MirrorPlane& plane) {
  const auto n_nodes = std::size_t(grid.nodes_per_cell());
  plane.cell.assign(grid.n_cells(), -1);
  std::vector<std::int32_t> images(n_nodes), others(n_nodes);
  for (std::size_t c = 0; c < grid.n_cells(); ++c) {
    bool below = false, above = false;
    for (std::size_t i = 0; i < n_nodes; ++i) {
      const auto node = grid.nodes_of(c)[i];
      images[i] = plane.node[std::size_t(node)];
      const double height_m = grid.position(node)[plane.axis] - plane.place_m;
      below = below || height_m < -tolerance_m;
      above = above || height_m > tolerance_m;
    }
    if (below == above) return false;  // the plane cuts through the cell
    const auto first = std::size_t(images[0]);
    std::sort(images.begin(), images.end());
    for (auto k = cells.begin[first]; k < cells.begin[first + 1] && plane.cell[c] < 0; ++k) {
      const auto other = cells.cell[k];
      others.assign(grid.nodes_of(std::size_t(other)), grid.nodes_of(std::size_t(other)) + n_nodes);
      std::sort(others.begin(), others.end());
      if (others == images) plane.cell[c] = other;
    }
    if (plane.cell[c] < 0) return false;
  }
  return true;
}

}  // namespace

std::optional<MirrorPlane> find_mirror_plane(const Grid& grid, const CellsOfNodes& cells) {
  const Box box = box_around(grid);
  const double tolerance_m = 1e-10 * box.size_m();
  std::optional<NodesByPlace> nodes;
  for (const int axis : {2, 0, 1}) {
    MirrorPlane plane;
    plane.axis = axis;
    plane.place_m = (box.low[std::size_t(axis)] + box.high[std::size_t(axis)]) / 2;
    if (!balances(grid, axis, plane.place_m, tolerance_m)) continue;
    if (!nodes) nodes.emplace(grid, tolerance_m);
    if (images_of_nodes(grid, *nodes, plane) && images_of_cells(grid, cells, tolerance_m, plane))
      return plane;
  }
  return std::nullopt;
}

}  // namespace fem
