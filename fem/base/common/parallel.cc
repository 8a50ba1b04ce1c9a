#include "fem/base/common/parallel.h"

#include <deal.II/base/parallel.h>

#include "fem/base/common/deadline.h"
#include "fem/base/common/library_function.h"

namespace fem {

namespace {

int blas_threads() {
  const auto get = library_function<int()>("openblas_get_num_threads");
  return get != nullptr ? get() : 1;
}

}  // namespace

void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  if (n == 0) return;
  const std::function<void(std::size_t, std::size_t)> in_time = [&](std::size_t begin, std::size_t end) {
    require_time();
    body(begin, end);
  };
  dealii::parallel::apply_to_subranges(std::size_t{0}, n, in_time, static_cast<unsigned>(grain));
}

void set_blas_threads(int n_threads) {
  if (const auto set = library_function<void(int)>("openblas_set_num_threads")) set(n_threads);
}

SerialBlas::SerialBlas() : n_threads_before_(blas_threads()) {
  set_blas_threads(1);
}

SerialBlas::~SerialBlas() {
  set_blas_threads(n_threads_before_);
}

SerialOpenMp::SerialOpenMp() {
  const auto get = library_function<int()>("omp_get_max_active_levels");
  levels_before_ = get != nullptr ? get() : 1;
  if (const auto set = library_function<void(int)>("omp_set_max_active_levels")) set(0);
}

SerialOpenMp::~SerialOpenMp() {
  if (const auto set = library_function<void(int)>("omp_set_max_active_levels")) set(levels_before_);
}

}  // namespace fem
