#include "fem/mesh/grid/grid.h"

#include <algorithm>

#include "fem/mesh/grid/hanging_nodes.h"

namespace fem {

std::vector<int> face_nodes(CellShape shape, int face) {
  if (shape.is_tetrahedron()) {
    static const std::vector<int> nodes[4] = {
        {1, 2, 3, 5, 9, 8}, {0, 3, 2, 7, 9, 6}, {0, 1, 3, 4, 8, 7}, {0, 2, 1, 6, 5, 4}};
    return nodes[face];
  }
  const int degree = shape.degree, n = degree + 1;
  const std::array<int, 3> stride = {{1, n, n * n}};
  const int axis = face / 2;
  const bool high = face % 2 == 1;
  int first = (axis + 1) % 3, second = (axis + 2) % 3;  // first x second = +axis
  if (!high) std::swap(first, second);
  std::vector<int> nodes;
  nodes.reserve(n * n);
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a)
      nodes.push_back((high ? degree * stride[axis] : 0) + a * stride[first] + b * stride[second]);
  return nodes;
}

std::vector<int> face_corners(CellShape shape) {
  if (shape.is_tetrahedron()) return {0, 1, 2};
  const int k = shape.degree;
  return {0, k, k * (k + 1), k * (k + 2)};
}

std::vector<int> corner_nodes(CellShape shape) {
  if (shape.is_tetrahedron()) return {0, 1, 2, 3};
  const int degree = shape.degree, n = degree + 1;
  std::vector<int> nodes(8);
  for (int c = 0; c < 8; ++c) nodes[c] = degree * ((c & 1) + n * ((c >> 1) & 1) + n * n * (c >> 2));
  return nodes;
}

namespace {

/// @param n_nodes_of, nodes_of  of each cell
template <typename Number, typename Nodes>
CellsOfNodes invert(const Grid& grid, const Number& n_nodes_of, const Nodes& nodes_of) {
  CellsOfNodes result;
  result.begin.assign(grid.n_nodes + 1, 0);
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int i = 0; i < n_nodes_of(c); ++i) ++result.begin[nodes_of(c)[i] + 1];
  for (std::size_t i = 0; i < grid.n_nodes; ++i) result.begin[i + 1] += result.begin[i];
  result.cell.resize(result.begin.back());
  auto next = result.begin;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int i = 0; i < n_nodes_of(c); ++i)
      result.cell[next[nodes_of(c)[i]]++] = static_cast<std::int32_t>(c);
  return result;
}

}  // namespace

CellsOfNodes cells_of_nodes(const Grid& grid) {
  return invert(
      grid, [n = grid.nodes_per_cell()](std::size_t) { return n; },
      [&](std::size_t c) { return grid.nodes_of(c); });
}

CellsOfNodes cells_that_couple(const Grid& grid, const CellCouplings& couplings) {
  return invert(
      grid, [&](std::size_t c) { return couplings.n_nodes(c); },
      [&](std::size_t c) { return couplings.nodes(c); });
}

std::vector<std::vector<std::int32_t>> colour_cells(const Grid& grid, const CellsOfNodes& cells) {
  const CellCouplings couplings(grid);
  const bool is_plain = grid.hanging.n() == 0;
  const CellsOfNodes of_hanging = is_plain ? CellsOfNodes{} : cells_that_couple(grid, couplings);
  const CellsOfNodes& coupled = is_plain ? cells : of_hanging;
  const auto corners = corner_nodes(grid.shape());
  std::vector<std::vector<std::int32_t>> groups;
  std::vector<int> colour(grid.n_cells(), -1);
  std::vector<char> taken;
  const auto take_neighbours = [&](std::int32_t node) {
    for (auto k = coupled.begin[node]; k < coupled.begin[node + 1]; ++k)
      if (colour[coupled.cell[k]] >= 0) taken[colour[coupled.cell[k]]] = 1;
  };
  for (std::size_t c = 0; c < grid.n_cells(); ++c) {
    taken.assign(groups.size() + 1, 0);
    if (is_plain)  // cells that share any node share a corner
      for (const int corner : corners) take_neighbours(grid.nodes_of(c)[corner]);
    else
      for (int i = 0; i < couplings.n_nodes(c); ++i) take_neighbours(couplings.nodes(c)[i]);
    colour[c] = static_cast<int>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (colour[c] == static_cast<int>(groups.size())) groups.emplace_back();
    groups[colour[c]].push_back(static_cast<std::int32_t>(c));
  }
  return groups;
}

}  // namespace fem
