/// MPI ranks: every one runs the same program on the same input. What the ranks agree on, and how they tell
/// each other. No deal.II.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "fem/base/values/errors.h"
#include "fem/base/values/solver_choice.h"

namespace fem {

/// Ranks of the communicator; 1 if MPI was not started.
int n_ranks(MPI_Comm communicator);

/// 0 if MPI was not started.
int this_rank(MPI_Comm communicator);

/// A failure that all ranks know of: they stay in step.
class FailedTogether : public SolveFailed {
public:
  using SolveFailed::SolveFailed;
};

/// A step of one's own that may fail. Called on all ranks.
/// @throws FailedTogether on all of several ranks, with the message of the first one whose step threw
void agree(MPI_Comm communicator, const std::function<void()>& step);

/// Sleeps until all ranks are here: one of them may be busy for long, and needs the processor.
void wait_for_all(MPI_Comm communicator);

/// A step of rank 0 alone; the others sleep until it is done. Called on all ranks.
/// @throws what the step throws on rank 0, FailedTogether with its message on the others
void on_first_rank(MPI_Comm communicator, const std::function<void()>& step);

/// Sums over the ranks, in their order: the same bits on all of them, and in every run.
void sum_over_ranks(MPI_Comm communicator, double* values, std::size_t n);

/// Values of which each rank has some, and zeros for what others have: all of them afterwards, on all ranks.
void complete(MPI_Comm communicator, double* values, std::size_t n);
void complete(MPI_Comm communicator, float* values, std::size_t n);
void complete(MPI_Comm communicator, std::int32_t* values, std::size_t n);
template <typename T>
void complete(MPI_Comm communicator, std::vector<T>& values) {
  complete(communicator, values.data(), values.size());
}

/// As complete, on rank 0 alone; the others' values are left as they are. Sums of what several ranks have are
/// taken in an order that MPI chooses.
void add_on_first(MPI_Comm communicator, double* values, std::size_t n);

/// What rank 0 has, on all ranks.
void take_from_first(MPI_Comm communicator, void* values, std::size_t n_bytes);

/// What each rank did, on all of them.
std::vector<RankWork> gather_work(MPI_Comm communicator, const RankWork& mine);

/// Memory of all machines that the ranks run on [bytes].
double memory_of_all_machines(MPI_Comm communicator);

/// This rank's share of the memory that its machine has left [bytes].
double free_memory_of_rank(MPI_Comm communicator);

}  // namespace fem
