/// Unit fields on a body's surface as few modes: the field at an instant, a sum over channels of factors
/// times unit fields, becomes a sum over modes that is as good and three times shorter.
///
/// With C the covariance of the factors over the cycle, C = R R^T, and A the unit fields (rows x K), the
/// eigenvectors Q of R^T A^T A R (K x K) by falling eigenvalue give modes U = A R Q and their factors
/// c = Q^T R^+ a: A a = U c for all factors a that C knows, and the first modes have the least error in the
/// mean square (Karhunen 1947, Loeve).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace pipelines {

/// Unit fields: rows are the components of a node together, node after node; a column per channel.
struct UnitFields {
  int n_components = 5;
  Eigen::MatrixXd values;

  Eigen::Index n_nodes() const { return values.rows() / n_components; }
};

struct FieldModes {
  Eigen::Index rank = 0;
  Eigen::MatrixXd projection;        ///< rank x K: c = projection * a
  Eigen::VectorXd steps;             ///< of the integers, by mode
  std::vector<std::int16_t> values;  ///< component after component, mode after mode, node after node
  /// Bound of the length of the difference to the full sum, at all nodes and instants of all sets: the
  /// largest of the modes left out, and what rounding to integers adds at most.
  double error = 0;
};

/// The fewest modes, in fours, whose error is within the tolerance; all that there are if none is.
/// @param sets       factors over the cycle (K x n) that the error holds for, at least one
/// @param tolerance  in the fields' unit
/// @param most       modes, a multiple of four; with fewer than needed the error says so
FieldModes field_modes(const UnitFields& fields, const std::vector<Eigen::ArrayXXd>& sets, double tolerance,
                       Eigen::Index most);

/// Largest length of the field over nodes and every `stride`th instant.
double largest_length(const UnitFields& fields, const Eigen::ArrayXXd& factors, Eigen::Index stride);

}  // namespace pipelines
