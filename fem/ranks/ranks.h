/// MPI ranks and what they agree on. Internal to fem.
///
/// Rank 0 has the models: it reads the mesh, makes the loads, and gives each rank the cells it works on. The
/// others wait in help_first_rank (helper_ranks.h) and take part in solving and in recovering stress.
#pragma once

#include <mpi.h>

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "fem/ranks/helper_ranks.h"
#include "fem/values/errors.h"
#include "fem/values/solver_choice.h"

namespace fem {

/// A failure that all ranks know of: they stay in step.
class FailedTogether : public SolveFailed {
public:
  using SolveFailed::SolveFailed;
};

/// A step of one's own that may fail. Called on all ranks.
/// @throws FailedTogether on all ranks, with the message of the first one whose step threw
void agree(MPI_Comm communicator, const std::function<void()>& step);

/// Work that all ranks do together. A failure that not all of them know of leaves the others waiting for
/// ever: it is told on stderr and ends them all with exit code 3.
void together(MPI_Comm communicator, const std::function<void()>& work);

/// Sum over the ranks, in their order: the same bits on all of them, and in every run.
Eigen::ArrayXd sum_over_ranks(MPI_Comm communicator, const Eigen::ArrayXd& mine);

/// What each rank did, on all of them.
std::vector<RankWork> gather_work(MPI_Comm communicator, const RankWork& mine);

/// Of all machines that the ranks run on [bytes]. Called on all ranks.
double memory_of_all_machines(MPI_Comm communicator);

}  // namespace fem
