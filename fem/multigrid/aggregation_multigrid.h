/// Multigrid for a stiffness between nodes that is too large to factorise: Chebyshev polynomials smooth it,
/// below them aggregates of nodes move as rigid bodies, then aggregates of aggregates (smoothed aggregation),
/// until what is left is small. Internal to fem.
#pragma once

#include <memory>
#include <vector>

#include "fem/matrices/block_matrix.h"
#include "fem/matrices/cholmod_factor.h"
#include "fem/mesh/rigid_modes.h"
#include "fem/multigrid/chebyshev.h"

namespace fem {

class AggregationMultigrid {
public:
  /// @param matrix  of a free body
  /// @param xyz_m   of the nodes, 3 each
  /// @throws SolveFailed as CholmodFactor
  AggregationMultigrid(const NodeGraph& graph, SymmetricMatrix matrix, const std::vector<double>& xyz_m,
                       const kernel::Kernels& kernels);

  struct LevelWorkSpace {
    Chebyshev::WorkSpace smoothing;
    BlockVector<float> force_below, below;
  };
  struct WorkSpace {
    std::vector<LevelWorkSpace> level;
    std::size_t bytes() const;
  };
  WorkSpace work_space(const Lanes& lanes) const;

  /// x = V b, one V-cycle: symmetric and positive on balanced forces.
  void apply(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x, WorkSpace& work) const;

  std::size_t bytes() const;

private:
  struct Level {
    BlockMatrix<float> stiffness, interpolation, restriction;
    std::unique_ptr<Chebyshev> smoother;
  };
  void build(BlockMatrix<double> stiffness, const std::vector<double>& xyz_m);
  void multiply(const BlockMatrix<float>& matrix, bool keep, const Lanes& lanes, const BlockVector<float>& x,
                BlockVector<float>& y) const;
  void descend(std::size_t number, const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x,
               WorkSpace& work) const;

  const kernel::Kernels* kernels_;
  std::vector<Level> levels_;
  std::unique_ptr<CholmodFactor> factor_;  ///< of the last one
  WithoutModes without_rigid_;             ///< there
  std::int32_t held_ = 0;                  ///< the aggregate there that does not move
  std::vector<std::int32_t> last_place_;   ///< nodes there keep their numbers in block vectors
};

}  // namespace fem
