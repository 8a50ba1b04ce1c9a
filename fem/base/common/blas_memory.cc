#include "fem/base/common/blas_memory.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "fem/base/common/library_function.h"
#include "fem/base/common/memory.h"
#include "fem/base/values/errors.h"

namespace fem {

namespace {

/// BUFFER_SIZE of OpenBLAS on x86-64, and what allocators round it up to.
constexpr std::size_t bytes_of_a_block = 160u << 20;
/// Left for all else: without as much no body is solved.
constexpr std::size_t bytes_besides = 64u << 20;

}  // namespace

void reserve_blas_memory(int n_threads) {
  const double limit_bytes = limit_of_process();
  if (std::isinf(limit_bytes)) return;
  const auto take = library_function<void*(int)>("blas_memory_alloc");
  const auto give_back = library_function<void(void*)>("blas_memory_free");
  if (take == nullptr || give_back == nullptr) return;
  const auto n_blocks =
      static_cast<std::size_t>(2 * n_threads - 1);  // the callers' and OpenBLAS' own threads'
  const auto needed_bytes = n_blocks * bytes_of_a_block + bytes_besides;
  if (!has_room_for(needed_bytes))
    throw DoesNotFit("this process may have " + std::to_string(static_cast<std::size_t>(limit_bytes) >> 20) +
                     " MB of memory (ulimit -v or -d), and to begin with " +
                     std::to_string(needed_bytes >> 20) + " MB more are needed on " +
                     std::to_string(n_threads) +
                     " threads: raise that limit, or take fewer threads (--threads)");
  std::vector<void*> blocks;
  for (int i = 0; i < n_threads; ++i) blocks.push_back(take(0));
  for (void* const block : blocks) give_back(block);
}

}  // namespace fem
