#include "fem/ranks.h"

#include <deal.II/base/mpi.h>

#include <stdexcept>
#include <string>

namespace fem {

void refuse_several_ranks(int n_ranks) {
  if (n_ranks > 1)
    throw std::runtime_error(
        "fem was started on " + std::to_string(n_ranks) +
        " MPI ranks and works on one: start the program without mpirun; it uses the threads of "
        "one machine (--threads)");
}

int n_ranks(MPI_Comm communicator) {
  return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(communicator));
}

}  // namespace fem
