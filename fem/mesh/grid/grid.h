/// The mesh as fem computes with it: nodes of the isoparametric cells, as plain arrays. Internal to fem.
///
/// Hexahedra Q_k: reference cell [0,1]^3. The (k+1)^3 nodes of a cell are lexicographic, the first coordinate
/// runs fastest. Face f of a cell is normal to axis f/2, at its low (f even) or high (f odd) end.
///
/// Tetrahedra P_2: reference cell with the corners 0, e_x, e_y, e_z. Nodes are those corners, then the
/// middles of the edges 01, 12, 20, 03, 13, 23 (VTK's order). Face f lies opposite corner f.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fem/base/values/cell_shape.h"

namespace fem {

struct BoundaryFace {
  std::int32_t cell = 0;
  int face = 0;         ///< 0..5, tetrahedra 0..3
  int boundary_id = 0;  ///< physical group
};

/// Nodes on the faces and edges of larger neighbours, whose polynomials fix their position and displacement:
/// value at node[i] = sum over k in begin[i] .. begin[i + 1] - 1 of weight[k] * value at master[k].
struct HangingNodes {
  std::vector<std::int32_t> node;     ///< ascending
  std::vector<std::size_t> begin{0};  ///< n + 1
  std::vector<std::int32_t> master;   ///< none of them hangs
  std::vector<double> weight;         ///< sum to 1 at each node

  std::size_t n() const noexcept { return node.size(); }
  /// @param masters  pairs of a master and its weight
  template <typename Masters>
  void add(std::int32_t hanging, const Masters& masters) {
    node.push_back(hanging);
    for (const auto& [of, share] : masters) {
      master.push_back(std::int32_t(of));
      weight.push_back(share);
    }
    begin.push_back(master.size());
  }
};

struct Grid {
  CellKind kind = CellKind::hexahedra;
  int degree = 2;
  std::size_t n_nodes = 0;
  std::vector<double> xyz_m;             ///< n_nodes x 3
  std::vector<std::int32_t> cell_nodes;  ///< n_cells x nodes_per_cell, in the order above
  std::vector<int> volume_id;            ///< n_cells
  std::vector<BoundaryFace> boundary;
  HangingNodes hanging{};  ///< of locally refined hexahedra

  std::size_t n_cells() const noexcept { return volume_id.size(); }
  std::size_t n_unknowns() const noexcept { return 3 * (n_nodes - hanging.n()); }
  CellShape shape() const noexcept { return {kind, degree}; }
  int nodes_per_cell() const noexcept { return shape().nodes_per_cell(); }
  int nodes_per_face() const noexcept { return shape().nodes_per_face(); }
  const std::int32_t* nodes_of(std::size_t cell) const { return cell_nodes.data() + cell * nodes_per_cell(); }
  const double* position(std::int32_t node) const { return xyz_m.data() + 3 * std::size_t(node); }
};

/// Local node numbers of a face. Hexahedra: lexicographic in two directions whose cross product points out of
/// the cell. Tetrahedra: corners counter-clockwise seen from outside, then the middles of the edges 01, 12,
/// 20.
std::vector<int> face_nodes(CellShape shape, int face);

/// Places of the corners among the nodes of a face.
std::vector<int> face_corners(CellShape shape);

/// Local node numbers of the corners: 8 lexicographic ones, or 4.
std::vector<int> corner_nodes(CellShape shape);

/// Corners at the ends of a tetrahedron's edges, in the order of their middle nodes 4 to 9.
inline constexpr std::array<std::array<int, 2>, 6> tetrahedron_edges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Cells that contain a node, for all nodes: cells of node i are cell[begin[i]] .. cell[begin[i+1]-1],
/// ascending.
struct CellsOfNodes {
  std::vector<std::size_t> begin;
  std::vector<std::int32_t> cell;
};
CellsOfNodes cells_of_nodes(const Grid& grid);

/// Groups of cells of which no two share a node. Adding to nodes group after group, in parallel inside a
/// group, gives the same sums for every number of threads.
std::vector<std::vector<std::int32_t>> colour_cells(const Grid& grid, const CellsOfNodes& cells);

}  // namespace fem
