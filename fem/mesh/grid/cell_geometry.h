/// The isoparametric map of one cell or face at tabulated points. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "fem/mesh/grid/grid.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {

using Points = Eigen::Matrix3Xd;  ///< one point per column

/// Jacobian dx/dxi (column = reference axis) of a cell at point q.
Eigen::Matrix3d jacobian(const Grid& grid, std::size_t cell, const Tabulation& at, int q);

/// Position of point q.
Eigen::Vector3d position(const Grid& grid, std::size_t cell, const Tabulation& at, int q);

/// Gradients of the shape functions in space at all points: row 3 q + d is the derivative along d, one column
/// per shape function; `jxw` the Jacobian's determinant times the weight (the determinant alone if `at` has
/// no weights).
struct CellGradients {
  Eigen::MatrixXd gradient;
  std::vector<double> jxw;
};
void compute_gradients(const Grid& grid, std::size_t cell, const Tabulation& at, CellGradients& result);

/// Point q of a face: where it is, and the outward normal times the area of its weight.
struct FacePoint {
  Eigen::Vector3d position, area;
};
FacePoint face_point(const Grid& grid, const std::vector<std::int32_t>& nodes, const Tabulation& at, int q);

/// Global nodes of a face in the order of face_nodes.
std::vector<std::int32_t> nodes_of_face(const Grid& grid, std::size_t cell, int face);

/// Cells whose Jacobian is not positive everywhere it is looked at (nodes and Gauss points), ascending.
std::vector<std::size_t> inverted_cells(const Grid& grid);

/// @throws MeshUnusable naming volume and place of the first of inverted_cells
void refuse_inverted_cells(const Grid& grid);

}  // namespace fem
