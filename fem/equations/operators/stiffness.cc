#include "fem/equations/operators/stiffness.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "fem/base/common/parallel.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {

namespace {

/// Gradients of a cell's shape functions times sqrt(JxW): three rows per node, one column per point.
void scale_gradients(const CellGradients& cell, Eigen::MatrixXd& scaled) {
  const auto n_points = static_cast<Eigen::Index>(cell.jxw.size());
  const auto n_nodes = cell.gradient.cols();
  scaled.resize(3 * n_nodes, n_points);
  for (Eigen::Index q = 0; q < n_points; ++q)
    for (Eigen::Index i = 0; i < n_nodes; ++i)
      scaled.block<3, 1>(3 * i, q) = std::sqrt(cell.jxw[q]) * cell.gradient.block<3, 1>(3 * q, i);
}

/// The block K_ij that goes with H_ij: lambda H + mu H' + mu tr(H) I.
Eigen::Matrix3d elastic_block(const Lame& elastic, const Eigen::Matrix3d& h) {
  Eigen::Matrix3d k = elastic.lambda_Pa * h + elastic.mu_Pa * h.transpose();
  k.diagonal().array() += elastic.mu_Pa * h.trace();
  return k;
}

}  // namespace

Lame lame(const Material& material) {
  const double e = material.youngs_modulus_Pa, nu = material.poisson_ratio;
  return {e * nu / ((1 + nu) * (1 - 2 * nu)), e / (2 * (1 + nu))};
}

void refuse_impossible(const Material& material) {
  const auto refuse = [](const char* key, double value, const char* rule) {
    std::ostringstream message;
    message << "material." << key << " = " << value << ": must " << rule;
    throw std::invalid_argument(message.str());
  };
  if (!(material.youngs_modulus_Pa > 0)) refuse("youngs_modulus", material.youngs_modulus_Pa, "be positive");
  if (!(material.poisson_ratio > -1 && material.poisson_ratio < 0.5))
    refuse("poisson_ratio", material.poisson_ratio, "lie between -1 and 0.5");
  if (!(material.density_kg_m3 > 0)) refuse("density", material.density_kg_m3, "be positive");
}

void add_cell_stiffness(const Eigen::MatrixXd& scaled, const std::int32_t* nodes, const Lame& elastic,
                        const NodeGraph& graph, Eigen::MatrixXd& products, SymmetricMatrix& matrix) {
  const auto n_local = static_cast<int>(scaled.rows() / 3);
  // Lower triangle of  H_ij = integral of grad N_i (x) grad N_j,  3 x 3 blocks.
  Eigen::MatrixXd& h = products;
  h.setZero(scaled.rows(), scaled.rows());
  h.selfadjointView<Eigen::Lower>().rankUpdate(scaled);
  for (int j = 0; j < n_local; ++j) {
    const Eigen::Matrix3d diagonal = h.block<3, 3>(3 * j, 3 * j).selfadjointView<Eigen::Lower>();
    add_block(graph, nodes[j], nodes[j], elastic_block(elastic, diagonal), matrix);
    for (int i = j + 1; i < n_local; ++i)
      add_block(graph, nodes[i], nodes[j], elastic_block(elastic, h.block<3, 3>(3 * i, 3 * j)), matrix);
  }
}

void hold_hanging(const HangingNodes& hanging, const NodeGraph& graph, SymmetricMatrix& matrix,
                  const std::vector<std::int32_t>& place) {
  const auto placed = [&](std::int32_t node) { return place.empty() ? node : place[std::size_t(node)]; };
  for (std::size_t i = 0; i < hanging.n(); ++i) {
    const auto master = 3 * std::int64_t(placed(hanging.master[hanging.begin[i]]));
    const double size = matrix.value[std::size_t(matrix.column_begin[std::size_t(master)])];
    const auto node = placed(hanging.node[i]);
    add_block(graph, node, node, size * Eigen::Matrix3d::Identity(), matrix);
  }
}

void assemble_stiffness(const Grid& grid, const std::vector<std::vector<std::int32_t>>& colours,
                        const NodeGraph& graph, const PerCell<Lame>& elastic, SymmetricMatrix& matrix,
                        const std::vector<std::int32_t>& place) {
  const auto placed = [&](std::int32_t node) { return place.empty() ? node : place[std::size_t(node)]; };
  const Tabulation at = gauss_in_cell(grid.shape(), grid.degree + 1);
  const CellCouplings couplings(grid);
  for (const auto& cells : colours)
    parallel_for(cells.size(), 16, [&](std::size_t begin, std::size_t end) {
      CellGradients gradients;
      Eigen::MatrixXd scaled, products;
      std::vector<std::int32_t> nodes;
      for (std::size_t c = begin; c < end; ++c) {
        const auto cell = std::size_t(cells[c]);
        compute_gradients(grid, cells[c], at, gradients);
        scale_gradients(gradients, scaled);
        couplings.couple(cell, 3, scaled);
        nodes.assign(couplings.nodes(cell), couplings.nodes(cell) + couplings.n_nodes(cell));
        for (auto& node : nodes) node = placed(node);
        add_cell_stiffness(scaled, nodes.data(), elastic[cells[c]], graph, products, matrix);
      }
    });
  hold_hanging(grid.hanging, graph, matrix, place);
}

}  // namespace fem
