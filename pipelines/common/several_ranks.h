/// The program under mpirun.
#pragma once

#include <mpi.h>

namespace pipelines {

/// Whether a launcher of MPI programs says that it started several processes: without one MPI is started only
/// where a body is looked at.
bool started_on_several_ranks();

/// The ranks that share the work on a body: all of them, or this one alone.
MPI_Comm ranks_of_a_body();
int n_ranks_of_a_body();
/// From here on this rank works on bodies of its own.
void work_on_bodies_alone();

}  // namespace pipelines
