#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/types.h>

#include <stdexcept>
#include <string>

#include "fem/common/parallel.h"
#include "fem/model/model.h"

namespace fem {

struct Environment::Impl {
  Impl(int& argc, char**& argv, unsigned n_threads) : mpi(argc, argv, n_threads) {}
  dealii::Utilities::MPI::MPI_InitFinalize mpi;
};

namespace {
bool mpi_runs() {
  int started = 0;
  MPI_Initialized(&started);
  return started != 0;
}
}  // namespace

Environment::Environment(int& argc, char**& argv, int n_threads) {
  if (n_threads < 0)
    throw std::invalid_argument("threads = " + std::to_string(n_threads) +
                                ": must be 0 (all cores) or positive");
  const unsigned n = n_threads == 0 ? dealii::numbers::invalid_unsigned_int : unsigned(n_threads);
  if (!mpi_runs())
    impl_ = std::make_unique<Impl>(argc, argv, n);
  else if (n_threads > 0)
    dealii::MultithreadInfo::set_thread_limit(n);
  set_blas_threads(static_cast<int>(dealii::MultithreadInfo::n_threads()));
}

Environment::~Environment() = default;

}  // namespace fem
