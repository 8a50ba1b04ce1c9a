/// One body solved by several MPI ranks, by whichever solver suits. Internal to fem.
#pragma once

#include <mpi.h>

#include <functional>
#include <memory>

#include "fem/base/values/solver_choice.h"
#include "fem/equations/loads/balanced_loads.h"
#include "fem/equations/operators/subdomain.h"
#include "fem/solve/solvers/direct_solve.h"
#include "fem/solve/solvers/mirrored_halves.h"
#include "fem/solve/solvers/petsc_solver.h"

namespace fem {

/// The half of a body that is solved by halves, or null; looked for when it is asked.
using HalfOfBody = std::function<const MirroredHalf*()>;

/// Displacements at the nodes of a rank's part.
struct PartSolution {
  RankPart part;
  Solution solution;
};

/// By the solver that the report names, or by the next one that fits into memory: the factor of halves on
/// rank 0, which has a third of the work or less; MUMPS' of the whole body on all ranks; the iteration. Where
/// an iteration that was asked for does not end, by the factor.
/// Called on all ranks.
/// @param loads  forces at the nodes of a part; their sizes are those of the body
/// @param kept   if given, has the factor or the levels afterwards; halves on rank 0 alone
PartSolution solve_on_ranks(const BodyOnRanks& body, const HalfOfBody& half,
                            const std::function<BalancedLoads(const RankPart&)>& loads, SolverChoice choice,
                            const StepReport& progress, SolverReport& report,
                            std::shared_ptr<const FactorisedBody>* kept);

}  // namespace fem
