/// A stress at a place, as what local refinement works towards.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace fem {

/// The sum over parts of tensor : stress, in one load case. The stress of a part is the mean over the cells
/// around its node, weighted with the node's shape function.
struct StressGoal {
  struct Part {
    std::size_t node = 0;            ///< index into the responses' nodes
    std::array<double, 6> tensor{};  ///< xx, yy, zz, xy, yz, xz; symmetric, so shear counts twice
  };
  std::vector<double> factors;  ///< of the load case, one per channel
  std::vector<Part> parts;
};

}  // namespace fem
