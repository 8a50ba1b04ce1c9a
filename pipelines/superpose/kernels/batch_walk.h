/// The walk of nodes through the instants, a batch at once, from their unit stresses.
#pragma once

#include <array>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "pipelines/superpose/kernels/superposition_kernel.h"
#include "pipelines/superpose/kernels/walked_factors.h"

namespace pipelines {

class BatchWalk {
public:
  /// @param factors, responses  outlive this
  BatchWalk(const WalkedFactors& factors, const fem::UnitResponses& responses);

  /// What the nodes of the rows from `first` on keep of all instants; the entries are overwritten by the next
  /// call.
  /// @param n_nodes  at most kernel::batch
  const std::array<kernel::NodeMaximum, kernel::batch>& of(std::size_t first, std::size_t n_nodes);

private:
  const WalkedFactors& factors_;
  const kernel::Factors kernel_factors_;
  const fem::UnitResponses& responses_;
  std::vector<double> coordinates_, room_;
  std::array<kernel::NodeMaximum, kernel::batch> found_;
};

}  // namespace pipelines
