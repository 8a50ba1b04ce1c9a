/// Two levels for a stiffness between nodes that is too large to factorise: Chebyshev polynomials smooth it,
/// below them aggregates of nodes move as rigid bodies (smoothed aggregation). Internal to fem.
#pragma once

#include <memory>
#include <vector>

#include "fem/block_matrix.h"
#include "fem/chebyshev.h"
#include "fem/cholmod_factor.h"

namespace fem {

class AggregationMultigrid {
public:
  /// @param matrix  of a free body
  /// @param xyz_m   of the nodes, 3 each
  /// @throws std::runtime_error as CholmodFactor
  AggregationMultigrid(const NodeGraph& graph, SymmetricMatrix matrix, const std::vector<double>& xyz_m,
                       const kernel::Kernels& kernels);

  struct WorkSpace {
    Chebyshev::WorkSpace smoothing;
    BlockVector<float> coarse;
    std::size_t bytes() const { return smoothing.bytes() + coarse.bytes(); }
  };
  WorkSpace work_space(const Lanes& lanes) const;

  /// x = V b, one V-cycle: symmetric and positive on balanced forces.
  void apply(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x, WorkSpace& work) const;

  std::size_t n_aggregates() const noexcept { return restriction_.n_rows(); }
  std::size_t bytes() const;

private:
  void build(BlockMatrix<double> stiffness, const std::vector<double>& xyz_m);
  void multiply(const Lanes& lanes, const BlockVector<float>& x, BlockVector<float>& y) const;

  const kernel::Kernels* kernels_;
  BlockMatrix<float> stiffness_, interpolation_, restriction_;
  std::unique_ptr<Chebyshev> smoother_;
  std::unique_ptr<CholmodFactor> factor_;
  std::int32_t held_ = 0;                   ///< the aggregate that does not move
  std::vector<std::int32_t> coarse_place_;  ///< three unknowns each keep their numbers in block vectors
};

}  // namespace fem
