/// How many multiply-adds one core does, compiled for the instruction sets of the superposition's inner
/// loops.
#pragma once

#include <cstddef>

namespace benchmarks::limit {

/// Multiply-adds in registers alone, as many chains side by side as hide their latency.
/// @param n_rounds  of one multiply-add in each lane of each chain
/// @param sum       of all lanes in the end, so that nothing is left out
/// @return floating-point operations done, two for a multiply-add
using MultiplyAdds = double(std::size_t n_rounds, double& sum);

#if defined(__x86_64__)
namespace avx512 {
MultiplyAdds multiply_adds;
}
namespace avx2 {
MultiplyAdds multiply_adds;
}
#endif
namespace generic {
MultiplyAdds multiply_adds;
}

}  // namespace benchmarks::limit
