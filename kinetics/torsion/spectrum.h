/// Singular values and vectors of C^(1/2) B J^(-1/2): the elastic modes of a reduced train.
#pragma once

#include <Eigen/Core>

#include "kinetics/torsion_chain/reduced.h"

namespace kinetics::torsion {

/// C^(1/2) B J^(-1/2) = edge_vectors diag(frequency) node_vectors^T. Never squared, so that each frequency is
/// accurate relative to itself; the rigid mode is no part of it, for the matrix has one row fewer than
/// columns.
struct Spectrum {
  Eigen::ArrayXd frequency_rad_s;  ///< n_edges, rising
  Eigen::MatrixXd node_vectors;    ///< n_nodes x n_edges, J^(1/2) times the modes; empty without vectors
  Eigen::MatrixXd edge_vectors;    ///< n_edges x n_edges
};

/// A chain by its bidiagonal matrix and LAPACK dbdsqr, any other tree by one-sided Jacobi rotations.
/// @throws std::runtime_error if either does not converge
Spectrum spectrum(const ReducedTrain& reduced, bool with_vectors);

/// Viscous damping ratio of the mode that dissipates as much per cycle; a loss factor counts half, D' in
/// full.
double mode_damping(const ReducedTrain& reduced, const Spectrum& spectrum, Index mode);

}  // namespace kinetics::torsion
