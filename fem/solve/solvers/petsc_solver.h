/// Unit responses by PETSc, on one MPI rank or several: conjugate gradients with two levels, or MUMPS'
/// factor. Internal to fem.
///
/// Two levels: the displacements of the mesh, smoothed by Chebyshev iteration over incomplete Cholesky
/// factors, and the trilinear ones below (linear_level.h), P'KP with a factor by MUMPS. A free body's rigid
/// motions are K's null space and are taken out of every vector. All of it can be set by PETSc's own options,
/// with the prefix `fem_` (petsc_options_of_user): PETSC_OPTIONS="-fem_mg_levels_ksp_max_it 2
/// -fem_ksp_monitor".
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "fem/base/values/solver_choice.h"
#include "fem/equations/loads/balanced_loads.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/solve/solvers/direct_solve.h"

namespace fem {

/// A body whose mesh all ranks of the communicator have.
struct BodyOnRanks {
  MPI_Comm communicator;
  const Grid& grid;
  const CellsOfNodes& cells;
  const PerCell<Lame> elastic;
};

/// All is called on all ranks, and fails on all of them.
class PetscSolver : public FactorisedBody {
public:
  /// Assembles K and prepares the factor (Solver::direct) or the two levels (Solver::iterative).
  /// @param rank_of_node  the rank that has each node
  /// @param clamped       unknowns; none: a free body
  /// @throws SolveFailed if K is not positive definite or memory does not suffice
  PetscSolver(const BodyOnRanks& body, std::vector<int> rank_of_node,
              const std::vector<std::int64_t>& clamped, const SolverChoice& choice);
  ~PetscSolver() override;

  /// The nodes whose rows this rank has, ascending; none of them hangs.
  const std::vector<std::int32_t>& nodes() const;

  /// @param loads  forces at nodes()
  /// @return displacements there, and the bytes of this rank
  /// @throws SolveFailed if the iteration does not end, or rounding reaches more than 1 % of displacements;
  ///   OutOfTime once the time is up, which the iteration asks in each step
  Solution solve_rows(const BalancedLoads& loads, const StepReport& progress) const;

  /// The same of the whole body, with what each rank gives and gets.
  Solution solve_whole(const BalancedLoads& loads, const StepReport& progress) const;

  Eigen::MatrixXd solve(const Eigen::MatrixXd& force) const override;
  bool is_on_all_ranks() const override { return true; }

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fem
