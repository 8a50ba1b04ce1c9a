/// Sums of arrays over the ranks. Internal to fem.
#pragma once

#include <Eigen/Dense>

#include "fem/ranks/ranks.h"

namespace fem {

inline Eigen::ArrayXd sum_over_ranks(MPI_Comm communicator, Eigen::ArrayXd mine) {
  sum_over_ranks(communicator, mine.data(), std::size_t(mine.size()));
  return mine;
}

}  // namespace fem
