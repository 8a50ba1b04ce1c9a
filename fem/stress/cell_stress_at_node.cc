#include "fem/stress/cell_stress_at_node.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/common/lagrange.h"
#include "fem/common/simplex.h"
#include "fem/operators/stiffness.h"
#include "fem/values/vtk_order.h"

namespace fem {
namespace {

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

/// Nodes of a cell in the order of grid.h.
std::vector<std::size_t> local_nodes(CellShape shape, const NodeList& cell) {
  const int* order = vtk_hexahedron_order(shape.degree);
  std::vector<std::size_t> nodes(cell.size());
  for (std::size_t v = 0; v < cell.size(); ++v)
    nodes[shape.is_tetrahedron() ? v : std::size_t(order[v])] = std::size_t(cell[v]);
  return nodes;
}

/// Gradients of all shape functions in reference coordinates, at one node.
std::vector<std::array<double, 3>> reference_gradients(CellShape shape, std::size_t node) {
  std::vector<std::array<double, 3>> gradients;
  if (shape.is_tetrahedron()) {
    for (const auto& function : quadratic_tetrahedron(tetrahedron_nodes()[node]))
      gradients.push_back(function.gradient);
    return gradients;
  }
  const auto x = nodes_on_edge(shape.degree);
  const std::size_t n = x.size();
  gradients.resize(n * n * n);
  const std::array<std::size_t, 3> at{node % n, node / n % n, node / (n * n)};
  for (std::size_t direction = 0; direction < 3; ++direction)
    for (std::size_t j = 0; j < n; ++j) {
      auto index = at;
      index[direction] = j;
      gradients[index[0] + n * index[1] + n * n * index[2]][direction] +=
          lagrange(x, x[at[direction]])[j].derivative;
    }
  return gradients;
}

/// Gradient in reference coordinates of a field given at the nodes of the cell.
template <typename Field>
std::array<double, 3> gradient_of(const Field& field,
                                  const std::vector<std::array<double, 3>>& shape_gradients) {
  std::array<double, 3> gradient{};
  for (std::size_t n = 0; n < shape_gradients.size(); ++n)
    for (std::size_t d = 0; d < 3; ++d)
      if (shape_gradients[n][d] != 0) gradient[d] += shape_gradients[n][d] * field(n);
  return gradient;
}

const Material& material_of(const Nodes& nodes, std::size_t cell, const Material& material,
                            const std::map<int, Material>& material_of_volume) {
  if (material_of_volume.empty()) return material;
  if (nodes.cell_volume_id.size() != nodes.n_cells())
    throw std::invalid_argument(
        "cell_stress_at_node_Pa: materials by volume, but the responses do not tell the volumes of cells");
  const auto own = material_of_volume.find(nodes.cell_volume_id[cell]);
  return own == material_of_volume.end() ? material : own->second;
}

}  // namespace

std::vector<std::vector<std::array<double, 6>>> cell_stress_at_node_Pa(
    const UnitResponses& responses, const Material& material, std::size_t node,
    const std::map<int, Material>& material_of_volume) {
  const std::size_t n_channels = responses.channels.size();
  std::vector<std::vector<std::array<double, 6>>> stress_Pa;
  const auto& nodes = responses.nodes;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::find(cell.begin(), cell.end(), std::int32_t(node)) == cell.end()) continue;
    const auto local = local_nodes(nodes.shape(), cell);
    const auto found = std::find(local.begin(), local.end(), node);
    const auto [lambda, mu] = lame(material_of(nodes, c, material, material_of_volume));
    auto& of_cell = stress_Pa.emplace_back(n_channels);
    const auto shape_gradients = reference_gradients(nodes.shape(), std::size_t(found - local.begin()));
    Matrix3 jacobian;  // d x_i / d reference_j
    for (int i = 0; i < 3; ++i)
      jacobian[i] = gradient_of([&](std::size_t n) { return nodes.xyz_m[3 * local[n] + std::size_t(i)]; },
                                shape_gradients);
    const Matrix3 to_unit = inverse(jacobian);
    for (std::size_t k = 0; k < n_channels; ++k) {
      Matrix3 gradient{};  // d u_i / d x_j
      for (int i = 0; i < 3; ++i) {
        const auto unit = gradient_of(
            [&](std::size_t n) {
              return responses.displacement_m[(local[n] * n_channels + k) * 3 + std::size_t(i)];
            },
            shape_gradients);
        for (int j = 0; j < 3; ++j)
          for (int d = 0; d < 3; ++d) gradient[i][j] += unit[d] * to_unit[d][j];
      }
      const double trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
      for (int i = 0; i < 3; ++i) of_cell[k][std::size_t(i)] = lambda * trace + 2 * mu * gradient[i][i];
      of_cell[k][3] = mu * (gradient[0][1] + gradient[1][0]);
      of_cell[k][4] = mu * (gradient[1][2] + gradient[2][1]);
      of_cell[k][5] = mu * (gradient[0][2] + gradient[2][0]);
    }
  }
  if (stress_Pa.empty())
    throw std::invalid_argument("cell_stress_at_node_Pa: no cell holds node " + std::to_string(node));
  return stress_Pa;
}

}  // namespace fem
