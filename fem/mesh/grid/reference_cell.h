/// Shape functions tabulated at points of the reference cell or face (grid.h). Internal to fem.
#pragma once

#include <array>
#include <vector>

#include "fem/base/values/cell_shape.h"

namespace fem {

using ReferencePoints = std::vector<std::array<double, 3>>;

/// value[q][i], gradient[q][i][axis], weight[q] flattened; shape functions in the order
/// of the nodes. Faces use axes 0 and 1 only.
struct Tabulation {
  int n_points = 0, n_shapes = 0;
  std::vector<double> value;
  std::vector<std::array<double, 3>> gradient;
  std::vector<double> weight;  ///< quadrature weights; empty for points that are no rule
  ReferencePoints point;       ///< in the reference cell
};

/// Gauss points, n in each direction; on tetrahedra and triangles symmetric rules that are exact to the same
/// degree 2 n - 1 (in all directions together), n <= 5.
Tabulation gauss_in_cell(CellShape shape, int n);
Tabulation gauss_on_face(CellShape shape, int n);

/// Gauss points that make the body's second moments and its mass matrix exact. N, x and det J have degree k,
/// k and 3 k - 1 in each direction; two of the former make 5 k - 1 in all. Tetrahedra: 2, 2 and 3.
Tabulation moment_points_in_cell(CellShape shape);

/// Where stress is sampled: the Gauss points of k in each direction; in tetrahedra and triangles deal.II's
/// rules of 6 and 4 points, which are not symmetric.
Tabulation stress_points_in_cell(CellShape shape);
Tabulation stress_points_on_face(CellShape shape);

/// The nodes of the cell themselves.
const Tabulation& nodes_in_cell(CellShape shape);

/// Any points, with weights if they are a rule.
Tabulation tabulate_in_cell(CellShape shape, const ReferencePoints& points,
                            const std::vector<double>& weights = {});
Tabulation tabulate_on_face(CellShape shape, const ReferencePoints& points);

/// Values of the corners' hat functions (trilinear, or linear on a tetrahedron) at a point of the reference
/// cell.
std::vector<double> corner_hats(CellShape shape, const std::array<double, 3>& point);

}  // namespace fem
