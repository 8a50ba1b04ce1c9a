/// Statically determinate supports: six unknowns held at three nodes. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <vector>

#include "fem/equations/matrices/symmetric_matrix.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// Corners of cells that hang on no others, ascending.
std::vector<std::int32_t> free_corners(const Grid& grid);

/// The six unknowns of a 3-2-1 support: all of a corner A, two of the corner B farthest from A (across AB),
/// one of the corner C farthest from the line AB (across the plane ABC). Ascending.
std::array<std::int64_t, 6> choose_supports(const Grid& grid);

/// The matrix rows of the supported unknowns, taken out of the matrix: what is left is positive definite.
class Supports {
public:
  /// Zeroes rows and columns of the unknowns and leaves their diagonal.
  Supports(const std::array<std::int64_t, 6>& unknowns, SymmetricMatrix& matrix)
      : Supports(std::vector<std::int64_t>(unknowns.begin(), unknowns.end()), matrix) {}
  /// Some of them: those that a part of the body has.
  Supports(std::vector<std::int64_t> unknowns, SymmetricMatrix& matrix);

  /// The supported rows, ascending.
  const std::vector<std::int64_t>& unknowns() const noexcept { return unknowns_; }

  /// K u in the supported rows (6 x columns), from the rows taken out.
  Eigen::MatrixXd images(const Eigen::MatrixXd& displacement) const;

private:
  std::vector<std::int64_t> unknowns_;
  Eigen::MatrixXd rows_;  // 6 x n
};

}  // namespace fem
