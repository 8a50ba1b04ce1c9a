#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/types.h>

#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

#include "fem/base/common/blas_memory.h"
#include "fem/base/common/parallel.h"
#include "fem/models/solid/model.h"

namespace fem {

/// deal.II begins PETSc and SLEPc too: they would take options from the command line, which is this
/// program's, from the environment and from files, and print and trap as these say. Of the environment's
/// options only those of our own solver count (petsc_options_of_user). Nor shall PETSc handle signals: it
/// would print and end MPI beside threads that still work.
struct Environment::Impl {
  explicit Impl(unsigned n_threads) : mpi(argc, argv, n_threads) {}
  char name[11] = "millstress", no_files[14] = "-skip_petscrc", no_handler[19] = "-no_signal_handler";
  char* arguments[4] = {name, no_files, no_handler, nullptr};
  char** argv = arguments;
  int argc = 3;
  dealii::Utilities::MPI::MPI_InitFinalize mpi;
};

namespace {
/// One process that no launcher has started needs neither Open MPI's daemon nor its networks, which take most
/// of the half second that MPI needs to begin. Nor its directory in TMPDIR: all such processes share it, and
/// the one that ends takes it from the one that starts, which then fails
/// (https://github.com/open-mpi/ompi/issues/3818). What the user's environment says goes before.
void begin_alone_quickly() {
  for (const char* by_launcher : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "SLURM_PROCID"})
    if (std::getenv(by_launcher) != nullptr) return;
  for (const auto& [name, value] :
       {std::pair("OMPI_MCA_ess_singleton_isolated", "1"), std::pair("OMPI_MCA_pml", "ob1"),
        std::pair("OMPI_MCA_btl", "self"), std::pair("OMPI_MCA_mtl", "^ofi"),
        std::pair("OMPI_MCA_osc", "^ucx"), std::pair("OMPI_MCA_orte_create_session_dirs", "0")})
    setenv(name, value, 0);
}

std::atomic<bool> is_left{false};

bool mpi_runs() {
  int started = 0;
  MPI_Initialized(&started);
  return started != 0;
}
}  // namespace

Environment::Environment(int n_threads) {
  if (n_threads < 0)
    throw std::invalid_argument("threads = " + std::to_string(n_threads) +
                                ": must be 0 (all cores) or positive");
  const unsigned n = n_threads == 0 ? dealii::numbers::invalid_unsigned_int : unsigned(n_threads);
  if (!mpi_runs()) {
    begin_alone_quickly();
    const char* const in_environment = std::getenv("PETSC_OPTIONS");
    const std::string options = in_environment == nullptr ? "" : in_environment;
    unsetenv("PETSC_OPTIONS");
    impl_ = std::make_unique<Impl>(n);
    if (in_environment != nullptr) setenv("PETSC_OPTIONS", options.c_str(), 1);
  } else if (n_threads > 0)
    dealii::MultithreadInfo::set_thread_limit(n);
  set_blas_threads(Environment::n_threads());
  reserve_blas_memory(Environment::n_threads());
}

Environment::~Environment() {
  if (is_left) static_cast<void>(impl_.release());
}

void Environment::leave_mpi() {
  is_left = true;
}

int Environment::n_threads() {
  return static_cast<int>(dealii::MultithreadInfo::n_threads());
}

}  // namespace fem
