/// fem runs on one MPI rank. Internal to fem.
#pragma once

#include <mpi.h>

namespace fem {

/// @throws std::runtime_error naming the number of ranks and the remedy if there are several
void refuse_several_ranks(int n_ranks);

/// Ranks of the communicator; 1 if MPI was not started.
int n_ranks(MPI_Comm communicator);

}  // namespace fem
