/// Series over the cycle as sums of few.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace pipelines {

struct TimeBasis {
  Eigen::MatrixXd basis;                ///< R x n, orthonormal rows
  std::vector<Eigen::MatrixXd> tables;  ///< by set: signals x R; set = table * basis
};

/// By Gram and Schmidt, the largest rest first, until no series misses more than a millionth of the largest
/// size that its signal has in any set.
/// @param sets  signals x n each
TimeBasis time_basis(const std::vector<Eigen::ArrayXXd>& sets);

}  // namespace pipelines
