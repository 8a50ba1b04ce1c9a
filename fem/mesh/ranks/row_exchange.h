/// Rows of nodes that other MPI ranks have. Internal to fem.
#pragma once

#include <mpi.h>

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace fem {

/// Everything here is called on all ranks.
class RowExchange {
public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// @param wanted  nodes that this rank wants, whoever has them
  RowExchange(const SharedRows& shared, std::vector<std::int32_t> wanted);

  const std::vector<std::int32_t>& wanted() const noexcept { return wanted_; }

  /// @param own  of the nodes that this rank has
  /// @return of the nodes wanted
  Rows operator()(const Eigen::Ref<const Rows>& own) const;

private:
  const SharedRows& shared_;
  std::vector<std::int32_t> wanted_;
  std::vector<std::vector<std::int32_t>> from_;  ///< by rank: places in wanted_
  std::vector<std::vector<std::int32_t>> to_;    ///< by rank: own rows that it wants
};

}  // namespace fem
