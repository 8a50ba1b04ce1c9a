/// CHOLMOD as its documentation shows it, without anything of ours: what our direct path is measured against.
#pragma once

#include <Eigen/Dense>

#include "fem/equations/matrices/symmetric_matrix.h"

namespace measure {

/// Analyse (METIS on the unknowns, supernodal), factorise, solve all right-hand sides at once.
/// @throws std::runtime_error if CHOLMOD fails
Eigen::MatrixXd solve_with_bare_cholmod(const fem::SymmetricMatrix& matrix, Eigen::MatrixXd right_hand_sides);

}  // namespace measure
