#include "pipelines/base/common/process_limits.h"

#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "fem/base/common/memory.h"
#include "pipelines/base/common/errors.h"

namespace pipelines {
namespace {
/// 256 kB do not suffice for Mesa's shaders, 1 MB does.
constexpr rlim_t usual_stack_bytes = 8u << 20, least_stack_bytes = 1u << 20;
/// Drawing failed with 300 MB left and went well with 1000.
constexpr std::size_t bytes_to_draw = std::size_t{1} << 30;
}  // namespace

void require_usable_stack() {
  rlimit stack{};
  if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= usual_stack_bytes) return;
  stack.rlim_cur = std::min(stack.rlim_max, usual_stack_bytes);
  setrlimit(RLIMIT_STACK, &stack);
  getrlimit(RLIMIT_STACK, &stack);
  if (stack.rlim_cur < least_stack_bytes)
    throw OptionError("the stack of this process may have " + std::to_string(stack.rlim_cur >> 10) +
                      " kB (ulimit -s), and 1024 are needed: raise that limit; 8192 are usual");
  pthread_attr_t threads;  // they have what the limit was when the process began
  if (pthread_attr_init(&threads) != 0) return;
  if (pthread_attr_setstacksize(&threads, stack.rlim_cur) == 0) pthread_setattr_default_np(&threads);
  pthread_attr_destroy(&threads);
}

bool memory_is_limited() {
  return std::isfinite(fem::limit_of_process());
}

bool has_memory_to_draw() {
  return !memory_is_limited() || fem::has_room_for(bytes_to_draw);
}

std::string why_nothing_draws() {
  return has_memory_to_draw() ? "this machine offers no EGL (package libegl1)"
                              : "the memory that this process may have (ulimit -v or -d) has no " +
                                    std::to_string(bytes_to_draw >> 20) + " MB left to draw in";
}

}  // namespace pipelines
