/// Multigrid that needs no hierarchy of meshes: displacements of degree 2 or 3 smoothed by Chebyshev
/// polynomials, trilinear ones in the same cells solved directly. In single precision: it preconditions
/// conjugate gradients in double. Internal to fem.
#pragma once

#include <vector>

#include "fem/block_vector.h"
#include "fem/coarse_space.h"
#include "fem/elastic_operator.h"

namespace fem {

/// @param elastic  in units of the largest modulus, so that single precision has room for every unit
class PolynomialMultigrid {
public:
  /// @throws std::runtime_error as CoarseSpace
  PolynomialMultigrid(const Grid& grid, const CellOrder& order, const std::vector<double>& metric,
                      const PerCell<Lame>& elastic,
                      const kernel::Kernels& kernels = kernel::kernels_for_this_machine());

  struct WorkSpace {
    BlockVector<float> direction, image, copies, coarse;
    std::size_t bytes() const { return direction.bytes() + image.bytes() + copies.bytes() + coarse.bytes(); }
  };
  WorkSpace work_space(const Lanes& lanes) const;

  /// x = V b, one V-cycle: symmetric and positive on balanced forces.
  void apply(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x, WorkSpace& work) const;

  std::size_t n_coarse_dofs() const noexcept { return 3 * coarse_.n_nodes(); }
  std::size_t bytes() const;

private:
  void find_largest_eigenvalue();
  /// Some Chebyshev steps on K x = b.
  void smooth(const Lanes& lanes, const BlockVector<float>& b, BlockVector<float>& x, bool from_zero,
              WorkSpace& work) const;

  const kernel::Kernels* kernels_;
  ElasticOperator<float> operator_;
  CoarseSpace coarse_;
  std::vector<float> inverse_blocks_;
  std::vector<std::int32_t> coarse_place_;  ///< coarse nodes keep their numbers in block vectors
  float largest_eigenvalue_ = 0;            ///< of the inverse blocks times K, not less
};

}  // namespace fem
