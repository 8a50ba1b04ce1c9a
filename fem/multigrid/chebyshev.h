/// A smoother for blocks of load cases: Chebyshev polynomials of D^-1 K, D the 3 x 3 diagonal blocks.
/// Internal to fem.
#pragma once

#include <functional>
#include <vector>

#include "fem/common/elastic_kernel.h"
#include "fem/operators/block_vector.h"
#include "fem/operators/shared_nodes.h"

namespace fem {

class Chebyshev {
public:
  /// y = K x; may set hanging nodes of x, whose values K does not depend on.
  using Apply = std::function<void(const Lanes&, BlockVector<float>& x, BlockVector<float>& y)>;
  /// Measured on shafts: 4 to 6 steps cost the same; a wide range suits stretched cells.
  static constexpr int n_steps = 5;
  static constexpr float range = 20;  ///< largest eigenvalue over the smallest that is smoothed
  struct WorkSpace {
    BlockVector<float> direction, image;
    std::size_t bytes() const { return direction.bytes() + image.bytes(); }
  };

  /// Estimates the largest eigenvalue from some columns of noise.
  /// @param diagonal_blocks  n_nodes x 9; nodes whose block is zero stay as they are
  /// @param apply  called for lanes of its own choice
  /// @param shared  nodes that other ranks have, too; none: one rank
  Chebyshev(const std::vector<double>& diagonal_blocks, const Apply& apply, const kernel::Kernels& kernels,
            const SharedNodes* shared = nullptr);

  std::size_t n_nodes() const noexcept { return inverse_blocks_.size() / 9; }
  std::size_t bytes() const noexcept { return inverse_blocks_.size() * sizeof(float); }
  /// Of D^-1 K: not less, as far as the iteration could see.
  float largest_eigenvalue() const noexcept { return largest_eigenvalue_; }
  WorkSpace work_space(const Lanes& lanes) const { return {{n_nodes(), lanes}, {n_nodes(), lanes}}; }

  /// Some steps on K x = b.
  /// @param from_zero  x is zero and not read
  void smooth(const Lanes& lanes, const Apply& apply, const BlockVector<float>& b, BlockVector<float>& x,
              bool from_zero, WorkSpace& work) const;
  /// work.image = b - K x
  void residual(const Lanes& lanes, const Apply& apply, const BlockVector<float>& b, BlockVector<float>& x,
                WorkSpace& work) const;

private:
  void find_largest_eigenvalue(const Apply& apply, const SharedNodes* shared);

  const kernel::Kernels* kernels_;
  std::vector<float> inverse_blocks_;
  float largest_eigenvalue_ = 0;
};

}  // namespace fem
