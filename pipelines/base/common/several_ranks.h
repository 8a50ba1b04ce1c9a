/// The program under mpirun.
#pragma once

#include <mpi.h>

namespace pipelines {

/// Whether a launcher of MPI programs says that it started several processes: without one MPI is started only
/// where a body is looked at.
bool started_on_several_ranks();

/// Number of this rank, as the launcher tells it before MPI is there; empty: it does not.
std::string number_from_launcher();

/// The ranks that share the work on a body: all of them, or this one alone.
MPI_Comm ranks_of_a_body();
int n_ranks_of_a_body();
/// Lets this rank work on bodies of its own from here on.
void work_on_bodies_alone();

/// Whether this is the rank that reads, writes and tells for those that share a body.
bool is_first_rank();

/// What that rank found, on all of them: a time, what a file says. Called on all ranks that share a body, in
/// the same order.
bool as_on_first_rank(bool value);
int as_on_first_rank(int value);
double as_on_first_rank(double value);

/// Sleeps until all ranks that share a body are here.
void wait_for_ranks();

}  // namespace pipelines
