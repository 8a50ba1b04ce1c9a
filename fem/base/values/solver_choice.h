/// Which solver finds the unit responses, and what it tells about its work. Plain values, no deal.II.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fem/base/values/errors.h"

namespace fem {

enum class Solver {
  automatic,  ///< the direct one while its factor fits into the memory that is free, else the iterative one
  direct,     ///< sparse factorisation (CHOLMOD; on several MPI ranks MUMPS, but for halves)
  iterative,  ///< PETSc's conjugate gradients with two levels
};

struct SolverChoice {
  Solver solver = Solver::automatic;
  double relative_tolerance = 1e-10;  ///< of the iterative solver: |K u - f| / |f| of every load as applied
  int max_iterations = 300;           ///< of the iterative solver, for each load case
  bool by_halves = true;     ///< the direct solver takes bodies that are their own mirror image by halves
  bool keep_factor = false;  ///< or the levels of the iterative one, for Model::goal_errors_Pa
};

/// What a solver is expected to need on a machine like the one that was measured (solver_prediction.h).
struct SolverCost {
  double seconds = 0;
  double bytes = 0;
};

/// Size of a sparse Cholesky factor by analysis of the matrix's pattern: known before the factor is computed,
/// for a body of any shape.
struct FactorSize {
  std::size_t n_dofs = 0;  ///< of the matrix; 0: not analysed
  double entries = 0;      ///< with the zeros that blocks of columns store
  double flops = 0;        ///< of the factorisation
  double bytes = 0;        ///< factor and matrix
};

/// The share of one of several MPI ranks.
struct RankWork {
  std::size_t n_cells = 0;
  std::size_t n_unknowns = 0;  ///< that it counts; together all of the body
  double bytes = 0;            ///< of its matrix rows and its part of the factor, or of the levels
};

struct SolverReport {
  Solver used = Solver::direct;
  std::string reason;  ///< why this one
  SolverCost predicted_direct, predicted_iterative;
  /// The factor, once its matrix was analysed: predicted_direct then follows from it.
  FactorSize factor{};
  double largest_aspect = 0;     ///< of the cells; 0: not looked at (tetrahedra)
  int n_iterations = 0;          ///< most of all load cases; 0: direct
  double relative_residual = 0;  ///< largest |K u - f| / |f|, computed anew from the solution
  /// What a second solve for the residual changed of the largest displacement, relative: how far rounding
  /// may reach, in the matrix too. 0: the residual was too small to ask.
  double rounding = 0;
  double used_bytes = 0;          ///< of matrix and factor, or of the levels; of all ranks
  std::vector<RankWork> ranks{};  ///< what each of several MPI ranks did; empty: one rank

  /// The cost of the solver that is used.
  const SolverCost& predicted() const noexcept {
    return used == Solver::iterative ? predicted_iterative : predicted_direct;
  }
};

}  // namespace fem
