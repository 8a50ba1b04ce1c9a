/// Several MPI ranks. Rank 0 runs the program; the others help it to solve and to recover stress, or do work
/// of their own where it lets them. No deal.II.
#pragma once

#include <mpi.h>

#include <functional>

namespace fem {

/// Ranks of the communicator; 1 if MPI was not started.
int n_ranks(MPI_Comm communicator);

/// 0 if MPI was not started.
int this_rank(MPI_Comm communicator);

/// On every rank but 0: takes part in what the models of rank 0 solve, until it dismisses its helpers. What
/// fails is thrown on rank 0.
/// @param own_work  done when rank 0 lets the others work; what it throws ends all ranks with exit code 3
/// @return the number given to dismiss_helpers
int help_first_rank(MPI_Comm communicator = MPI_COMM_WORLD, const std::function<void()>& own_work = {});

/// On rank 0: the others do their own work beside this rank.
void let_others_work(MPI_Comm communicator = MPI_COMM_WORLD);
/// On rank 0: it knows that the work of all of them is done.
void others_have_worked();

/// On rank 0, at the end: the others return from help_first_rank. Where they work still, all ranks end at
/// once with the exit code. Nothing happens on one rank.
void dismiss_helpers(int exit_code = 0, MPI_Comm communicator = MPI_COMM_WORLD);

/// What rank 0 can ask for. Internal to fem.
enum class Task { end, own_work, tell_memory, solve_directly, solve_iteratively, recover_stress };

/// What rank 0 asks for. Internal to fem.
struct HelperCall {
  Task task = Task::end;
  int exit_code = 0;  ///< with Task::end
};

/// On a helper: the next call of rank 0. Sleeps meanwhile: rank 0 may be long in meshing or superposing, and
/// needs the processor. Internal to fem.
HelperCall wait_for_call(MPI_Comm communicator);

/// Rank 0: the others take part in the task that it begins now. Internal to fem.
void call_helpers(Task task, MPI_Comm communicator);

}  // namespace fem
