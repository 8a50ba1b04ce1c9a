/// The consistent mass matrix. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fem/base/values/per_cell.h"
#include "fem/equations/matrices/symmetric_matrix.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// M_ij = integral of rho N_i N_j, the same for the three directions; exact on isoparametric cells.
class MassMatrix {
public:
  MassMatrix(const Grid& grid, const std::vector<std::vector<std::int32_t>>& colours, const NodeGraph& graph,
             const PerCell<double>& density_kg_m3);

  /// M X for all columns of X (3 n_nodes x columns); the same bits for every number of threads.
  Eigen::MatrixXd operator*(const Eigen::MatrixXd& x) const;

private:
  SymmetricMatrix nodes_;  // one unknown per node
};

}  // namespace fem
