/// Stiffness of isotropic linear elasticity on isoparametric hexahedra. Internal to fem.
#pragma once

#include "fem/body.h"
#include "fem/grid.h"
#include "fem/symmetric_matrix.h"

namespace fem {

/// Lame's constants [Pa].
struct Lame {
  double lambda_Pa = 0, mu_Pa = 0;
};
Lame lame(const Material& material);

/// @throws std::invalid_argument unless youngs_modulus > 0, -1 < poisson_ratio < 0.5, density > 0
void refuse_impossible(const Material& material);

/// Adds all cells' stiffness with (k+1)^3 Gauss points: colour after colour, so that the sums do not depend
/// on threads.
/// @param matrix  made from the graph, zero on entry
void assemble_stiffness(const Grid& grid, const std::vector<std::vector<std::int32_t>>& colours,
                        const NodeGraph& graph, const Material& material, SymmetricMatrix& matrix);

}  // namespace fem
