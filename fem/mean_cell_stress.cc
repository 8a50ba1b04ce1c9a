#include "fem/mean_cell_stress.h"

#include <algorithm>
#include <stdexcept>

#include "fem/vtk_order.h"

namespace fem {
namespace {

/// Derivative at node i of the quadratic Lagrange polynomial of node j on {0, 1/2, 1}.
constexpr double derivative[3][3] = {{-3, 4, -1}, {-1, 0, 1}, {1, -4, 3}};

using Matrix3 = std::array<std::array<double, 3>, 3>;

Matrix3 inverse(const Matrix3& m) {
  Matrix3 result;
  double determinant = 0;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    determinant += m[0][i] * (m[1][i1] * m[2][i2] - m[1][i2] * m[2][i1]);
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      result[i][j] = m[j1][i1] * m[j2][i2] - m[j1][i2] * m[j2][i1];
    }
  }
  for (auto& row : result)
    for (double& entry : row) entry /= determinant;
  return result;
}

/// Gradient in unit-cell coordinates, at lexicographic node (a, b, c), of a field given at the 27
/// lexicographic nodes.
template <typename Field>
std::array<double, 3> unit_gradient(const Field& field, const std::array<int, 3>& at) {
  std::array<double, 3> gradient{};
  for (int direction = 0; direction < 3; ++direction)
    for (int j = 0; j < 3; ++j) {
      auto index = at;
      index[direction] = j;
      gradient[direction] += derivative[at[direction]][j] * field(index[0] + 3 * index[1] + 9 * index[2]);
    }
  return gradient;
}

}  // namespace

std::vector<std::array<double, 6>> mean_cell_stress_Pa(const UnitResponses& responses,
                                                       const Material& material, std::size_t node) {
  const std::size_t n_channels = responses.channels.size();
  const double nu = material.poisson_ratio;
  const double lambda = material.youngs_modulus_Pa * nu / ((1 + nu) * (1 - 2 * nu));
  const double mu = material.youngs_modulus_Pa / (2 * (1 + nu));
  std::vector<std::array<double, 6>> mean(n_channels);
  int n_cells = 0;
  for (const auto& cell : responses.nodes.cells) {
    std::array<std::size_t, 27> lexicographic;
    for (std::size_t v = 0; v < 27; ++v)
      lexicographic[std::size_t(vtk_hexahedron_from_lexicographic[v])] = std::size_t(cell[v]);
    const auto found = std::find(lexicographic.begin(), lexicographic.end(), node);
    if (found == lexicographic.end()) continue;
    ++n_cells;
    const int position = int(found - lexicographic.begin());
    const std::array<int, 3> at{position % 3, position / 3 % 3, position / 9};
    Matrix3 jacobian;  // d x_i / d unit_j
    for (int i = 0; i < 3; ++i)
      jacobian[i] = unit_gradient(
          [&](int n) { return responses.nodes.xyz_m[3 * lexicographic[std::size_t(n)] + std::size_t(i)]; },
          at);
    const Matrix3 to_unit = inverse(jacobian);
    for (std::size_t k = 0; k < n_channels; ++k) {
      Matrix3 gradient{};  // d u_i / d x_j
      for (int i = 0; i < 3; ++i) {
        const auto unit = unit_gradient(
            [&](int n) {
              return responses
                  .displacement_m[(lexicographic[std::size_t(n)] * n_channels + k) * 3 + std::size_t(i)];
            },
            at);
        for (int j = 0; j < 3; ++j)
          for (int d = 0; d < 3; ++d) gradient[i][j] += unit[d] * to_unit[d][j];
      }
      const double trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
      for (int i = 0; i < 3; ++i) mean[k][std::size_t(i)] += lambda * trace + 2 * mu * gradient[i][i];
      mean[k][3] += mu * (gradient[0][1] + gradient[1][0]);
      mean[k][4] += mu * (gradient[1][2] + gradient[2][1]);
      mean[k][5] += mu * (gradient[0][2] + gradient[2][0]);
    }
  }
  if (n_cells == 0)
    throw std::invalid_argument("mean_cell_stress_Pa: no cell holds node " + std::to_string(node));
  for (auto& stress : mean)
    for (double& component : stress) component /= n_cells;
  return mean;
}

}  // namespace fem
