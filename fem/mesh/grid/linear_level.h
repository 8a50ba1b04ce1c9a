/// The trilinear displacements (linear ones in tetrahedra) among those of a mesh of higher degree: the coarse
/// level of two. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/mesh/grid/grid.h"

namespace fem {

/// Interpolation to each node from vertices, which are nodes themselves: those that are a corner of all their
/// cells and do not hang. Value at node i = sum over k in begin[i] .. begin[i + 1] - 1 of weight[k] * value
/// at vertex[k]. A node that hangs has no row.
struct LinearLevel {
  std::vector<std::size_t> begin{0};
  std::vector<std::int32_t> vertex;
  std::vector<double> weight;

  bool is_vertex(std::int32_t node) const {
    return begin[std::size_t(node) + 1] == begin[std::size_t(node)] + 1 &&
           vertex[begin[std::size_t(node)]] == node;
  }
};

/// A node inside a cell, or on an edge or face of it, follows the corners of the largest such cell. A corner
/// that hangs follows its masters in turn.
LinearLevel make_linear_level(const Grid& grid);

}  // namespace fem
