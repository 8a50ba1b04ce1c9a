/// Shape functions of Q_k tabulated at points of the reference cell or face. Internal to fem.
#pragma once

#include <array>
#include <vector>

namespace fem {

/// value[q][i], gradient[q][i][axis], weight[q] flattened; shape functions lexicographic. Faces use axes 0
/// and 1 only.
struct Tabulation {
  int n_points = 0, n_shapes = 0;
  std::vector<double> value;
  std::vector<std::array<double, 3>> gradient;
  std::vector<double> weight;                ///< quadrature weights; empty for nodes
  std::vector<std::array<double, 3>> point;  ///< in the reference cell
};

/// Gauss points, n in each direction.
Tabulation gauss_in_cell(int degree, int n);
Tabulation gauss_on_face(int degree, int n);

/// The nodes of the cell themselves.
Tabulation nodes_in_cell(int degree);

/// Values of the 8 trilinear hat functions of the corners (lexicographic) at a point of the reference cell.
std::array<double, 8> corner_hats(const std::array<double, 3>& point);

}  // namespace fem
