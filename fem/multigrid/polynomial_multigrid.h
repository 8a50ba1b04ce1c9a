/// Multigrid that needs no hierarchy of meshes: displacements of degree 2 or 3 smoothed by Chebyshev
/// polynomials, below them trilinear ones in the same cells. In single precision: it preconditions conjugate
/// gradients in double. Internal to fem.
#pragma once

#include <memory>
#include <vector>

#include "fem/multigrid/chebyshev.h"
#include "fem/multigrid/coarse_space.h"
#include "fem/operators/block_vector.h"
#include "fem/operators/elastic_operator.h"

namespace fem {

/// @param elastic  in units of the largest modulus, so that single precision has room for every unit
class PolynomialMultigrid {
public:
  /// @param level  how the trilinear displacements are treated: factorised or aggregated
  /// @param shared  nodes that other ranks have, too; none: one rank
  /// @throws SolveFailed as CoarseSpace
  PolynomialMultigrid(const Grid& grid, const CellOrder& order, const std::vector<double>& metric,
                      const PerCell<Lame>& elastic, CoarseLevel level,
                      const kernel::Kernels& kernels = kernel::kernels_for_this_machine(),
                      const SharedNodes* shared = nullptr);

  struct WorkSpace {
    Chebyshev::WorkSpace smoothing;
    BlockVector<float> copies, coarse_force, coarse;
    CoarseSpace::WorkSpace below;
    std::size_t bytes() const {
      return smoothing.bytes() + copies.bytes() + coarse_force.bytes() + coarse.bytes() + below.bytes();
    }
  };
  WorkSpace work_space(const Lanes& lanes) const;

  /// x = V b, one V-cycle: symmetric and positive on balanced forces.
  void apply(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x, WorkSpace& work) const;

  std::size_t bytes() const;
  std::shared_ptr<const AddTargets> targets() const noexcept { return operator_.targets(); }

private:
  const kernel::Kernels* kernels_;
  const SharedNodes* shared_;
  CoarseSpace coarse_;
  ElasticOperator<float> operator_;
  std::unique_ptr<Chebyshev> smoother_;
};

}  // namespace fem
