/// Lowest modes of vibration by SLEPc's Krylov-Schur iteration, which inverts the stiffness. Internal to fem.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "fem/base/common/dense_algebra.h"

namespace fem {

using BlockOperator = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

/// K x = w^2 M x: symmetric matrices by their products, any number of columns at a time.
struct VibrationProblem {
  Eigen::Index n_rows = 0;
  BlockOperator stiffness;  ///< X -> K X
  BlockOperator mass;       ///< X -> M X, definite on what `inverse` returns
  BlockOperator inverse;    ///< F -> K^-1 F on the motions that K resists; semidefinite
  /// Rigid motions and other shapes X with X'MX = I that are not searched for; may have no columns.
  Eigen::MatrixXd left_out;
  /// Where the first search starts; fixed pseudo-random numbers if it is empty.
  Eigen::VectorXd start;
};

/// The lowest w^2, ascending, each as often as it is repeated, with X'MX = I. Same bits for the same
/// products. PETSc's options in the environment and in files do not count, and it prints nothing.
/// @param n_modes  at least 1, less than the rank of `inverse` beside what is left out
/// @throws SolveFailed if SLEPc does not converge or fails; what a product throws comes through
Eigenpairs lowest_modes(const VibrationProblem& problem, int n_modes);

}  // namespace fem
