/// The mesh as fem computes with it: nodes of the isoparametric Q_k hexahedra, as plain arrays. Internal to
/// fem.
///
/// Reference cell [0,1]^3. The (k+1)^3 nodes of a cell are lexicographic, the first coordinate runs fastest.
/// Face f of a cell is normal to axis f/2, at its low (f even) or high (f odd) end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fem {

struct BoundaryFace {
  std::int32_t cell = 0;
  int face = 0;         ///< 0..5
  int boundary_id = 0;  ///< physical group
};

struct Grid {
  int degree = 2;
  std::size_t n_nodes = 0;
  std::vector<double> xyz_m;             ///< n_nodes x 3
  std::vector<std::int32_t> cell_nodes;  ///< n_cells x (k+1)^3, lexicographic
  std::vector<int> volume_id;            ///< n_cells
  std::vector<BoundaryFace> boundary;

  std::size_t n_cells() const noexcept { return volume_id.size(); }
  int nodes_per_cell() const noexcept { return (degree + 1) * (degree + 1) * (degree + 1); }
  int nodes_per_face() const noexcept { return (degree + 1) * (degree + 1); }
  const std::int32_t* nodes_of(std::size_t cell) const { return cell_nodes.data() + cell * nodes_per_cell(); }
  const double* position(std::int32_t node) const { return xyz_m.data() + 3 * std::size_t(node); }
};

/// Local node numbers of a face, lexicographic in two directions whose cross product points out of the cell.
std::vector<int> face_nodes(int degree, int face);

/// Local node numbers of the 8 corners, lexicographic.
std::array<int, 8> corner_nodes(int degree);

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
