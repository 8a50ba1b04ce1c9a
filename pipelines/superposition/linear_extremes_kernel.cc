/// Compiled once per instruction set, with KERNEL_VARIANT naming the variant (pipelines/CMakeLists.txt). No
/// other header with inline code may be included here: the linker would keep one copy of it, for one
/// instruction set, for all callers.
#include "pipelines/superposition/linear_extremes_kernel.h"

#include "pipelines/superposition/superposition_kernel.h"

namespace pipelines::kernel::KERNEL_VARIANT {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t n_form_lanes = 8;
#elif defined(__AVX__)
constexpr std::size_t n_form_lanes = 4;
#else
constexpr std::size_t n_form_lanes = 2;
#endif
using FormLanes = double __attribute__((vector_size(8 * n_form_lanes)));
using FormIndices = long __attribute__((vector_size(8 * n_form_lanes)));
static_assert(block % n_form_lanes == 0);

/// Of each lane the extremes so far, and in which group of instants they were first.
struct Range {
  FormLanes largest, smallest;
  FormIndices largest_group, smallest_group;

  void start() {
    largest = FormLanes{} - __builtin_huge_val();
    smallest = FormLanes{} + __builtin_huge_val();
    largest_group = smallest_group = FormIndices{};
  }
  void take(FormLanes value, long of_group) {
    const auto above = value > largest, below = value < smallest;
    largest = above ? value : largest;
    largest_group = above ? FormIndices{} + of_group : largest_group;
    smallest = below ? value : smallest;
    smallest_group = below ? FormIndices{} + of_group : smallest_group;
  }
  void finish(LinearExtremes& found) const {
    found = {largest[0], smallest[0], instant(largest_group, 0), instant(smallest_group, 0)};
    for (std::size_t i = 1; i < n_form_lanes; ++i) {
      const long upper = instant(largest_group, i), lower = instant(smallest_group, i);
      if (largest[i] > found.largest || (largest[i] == found.largest && upper < found.largest_instant)) {
        found.largest = largest[i];
        found.largest_instant = upper;
      }
      if (smallest[i] < found.smallest || (smallest[i] == found.smallest && lower < found.smallest_instant)) {
        found.smallest = smallest[i];
        found.smallest_instant = lower;
      }
    }
  }

private:
  static long instant(const FormIndices& group, std::size_t lane) {
    return group[lane] * long(n_form_lanes) + long(lane);
  }
};

}  // namespace

void linear_walk(const double* weights, std::size_t n_forms, std::size_t n_channels, const double* factors,
                 std::size_t n_blocks, LinearExtremes* found) {
  for (std::size_t first = 0; first < n_forms; first += forms_at_once) {
    Range ranges[forms_at_once];
    for (Range& range : ranges) range.start();
    const double* w = weights + first * n_channels;
    for (std::size_t b = 0; b < n_blocks; ++b)
      for (std::size_t g = 0; g < block / n_form_lanes; ++g) {
        const double* a = factors + b * n_channels * block + g * n_form_lanes;
        FormLanes value[forms_at_once] = {};
        for (std::size_t k = 0; k < n_channels; ++k, a += block) {
          FormLanes factor;
          __builtin_memcpy(&factor, a, sizeof factor);
#pragma GCC unroll 4
          for (std::size_t i = 0; i < forms_at_once; ++i) value[i] += w[i * n_channels + k] * factor;
        }
#pragma GCC unroll 4
        for (std::size_t i = 0; i < forms_at_once; ++i)
          ranges[i].take(value[i], long(b * (block / n_form_lanes) + g));
      }
    for (std::size_t i = 0; i < forms_at_once; ++i) ranges[i].finish(found[first + i]);
  }
}

}  // namespace pipelines::kernel::KERNEL_VARIANT
