/// Which solver finds the unit responses, and what it tells about its work. Plain values, no deal.II.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fem/values/errors.h"

namespace fem {

enum class Solver {
  automatic,  ///< of those that suit the body and fit into memory: the iterative one if predicted to save
              ///< more than a second, else the direct one. Where few cells are stretched more than 1 : 12
              ///< and none more than 1 : 25 the analysis of the matrix decides
  direct,     ///< sparse factorisation (CHOLMOD; on several MPI ranks MUMPS, but for halves)
  iterative,  ///< conjugate gradients with polynomial multigrid; the direct one if that does not converge
};

/// How the iterative solver treats the trilinear displacements, its level below the polynomials of the mesh.
enum class CoarseLevel {
  automatic,   ///< factorised as long as that is predicted to be the faster one
  factorised,  ///< sparse factorisation: fewest iterations, cost grows faster than the unknowns
  aggregated,  ///< one more level of multigrid, of rigid bodies: cost grows as the unknowns
};

/// Times SolverChoice::max_iterations where there is no other way, or who asks has the time: thin walls and
/// stretched cells take 90 to 200 steps.
inline constexpr int patience = 3;

struct SolverChoice {
  Solver solver = Solver::automatic;
  double relative_tolerance = 1e-10;  ///< of the iterative solver: |K u - f| / |f| of every load as applied
  int max_iterations = 100;           ///< of the iterative solver, per block of load cases
  CoarseLevel coarse_level = CoarseLevel::automatic;
  bool gave_up_before =
      false;                 ///< the iteration is known to stall on this mesh and material: not tried again
  bool by_halves = true;     ///< the direct solver takes bodies that are their own mirror image by halves
  bool keep_factor = false;  ///< of the direct solver, for Model::goal_errors_Pa
};

/// What a solver is expected to need on a machine like the one that was measured (solver_prediction.h).
struct SolverCost {
  double seconds = 0;
  double bytes = 0;
};

/// Of a sparse Cholesky factor, by analysis of the matrix's pattern: known before it is computed, for a body
/// of any shape.
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
  double bytes = 0;            ///< matrix and its part of the factor, or operator, preconditioner and vectors
};

struct SolverReport {
  Solver used = Solver::direct;
  std::string reason;        ///< why this one; if the iterative one gave up, how
  bool gave_up = false;      ///< the iterative one stalled, here or before (SolverChoice::gave_up_before)
  bool by_analysis = false;  ///< direct, unless the analysed factor turns out too expensive
  SolverCost predicted_direct, predicted_iterative;
  FactorSize
      factor{};  ///< of the direct one, once its matrix was analysed: then what is predicted follows from it
  CoarseLevel coarse_level = CoarseLevel::factorised;  ///< of the iterative one, decided
  double largest_aspect = 0;                           ///< of the cells; 0: not looked at (tetrahedra)
  int n_iterations = 0;                                ///< most of all blocks; 0: direct
  double relative_residual = 0;  ///< largest |K u - f| / |f|, computed anew from the solution
  /// What a second solve for the residual changed of the largest displacement, relative: how far rounding
  /// may reach, in the matrix too. 0: the residual was too small to ask.
  double rounding = 0;
  double used_bytes = 0;  ///< matrix and factor, or operator, preconditioner and vectors; of all ranks
  std::vector<RankWork> ranks{};  ///< what each of several MPI ranks did; empty: one rank

  /// Of the solver used.
  const SolverCost& predicted() const noexcept {
    return used == Solver::iterative ? predicted_iterative : predicted_direct;
  }
};

}  // namespace fem
