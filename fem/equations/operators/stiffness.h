/// Stiffness of isotropic linear elasticity on isoparametric cells. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/per_cell.h"
#include "fem/equations/matrices/symmetric_matrix.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// Lame's constants [Pa].
struct Lame {
  double lambda_Pa = 0, mu_Pa = 0;
};
Lame lame(const Material& material);

/// Cells without stiffness are there for the nodes of others that hang on them (StiffnessShare).
inline bool has_stiffness(const Lame& elastic) {
  return elastic.mu_Pa > 0;
}

/// @throws std::invalid_argument unless youngs_modulus > 0, -1 < poisson_ratio < 0.5, density > 0
void refuse_impossible(const Material& material);

/// Adds all cells' stiffness with (k+1)^3 Gauss points: colour after colour, so that the sums do not depend
/// on threads. Hanging nodes are resolved: their rows and columns keep a diagonal only.
/// @param matrix  made from the graph, zero on entry
/// @param place   of each node among those of graph and matrix; empty: they are numbered like the mesh
void assemble_stiffness(const Grid& grid, const std::vector<std::vector<std::int32_t>>& colours,
                        const NodeGraph& graph, const PerCell<Lame>& elastic, SymmetricMatrix& matrix,
                        const std::vector<std::int32_t>& place = {});

/// Gives hanging nodes a diagonal of the others' size: equations of their own that say nothing.
/// @param place  as assemble_stiffness
void hold_hanging(const HangingNodes& hanging, const NodeGraph& graph, SymmetricMatrix& matrix,
                  const std::vector<std::int32_t>& place = {});

/// Adds one cell's stiffness to the matrix.
/// @param scaled  gradients of the cell's shape functions times sqrt(JxW): three rows per node, one column
///                per quadrature point
/// @param nodes   of the cell
/// @param products  work space
void add_cell_stiffness(const Eigen::MatrixXd& scaled, const std::int32_t* nodes, const Lame& elastic,
                        const NodeGraph& graph, Eigen::MatrixXd& products, SymmetricMatrix& matrix);

}  // namespace fem
