/// Twelve load cases by both solvers: what each takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem/values/body.h"
#include "fem/values/solver_choice.h"
#include "fem/values/unit_load.h"

namespace measure {

struct SolverFigures {
  double cpu_s = 0, wall_s = 0;  ///< from the mesh and the loads to the displacements
  double bytes = 0;              ///< largest resident memory of the whole process meanwhile
  double bytes_before = 0;       ///< of these: mesh, loads, program
  double predicted_s = 0, predicted_bytes = 0;
};

/// Names of what solves the trilinear level.
inline constexpr const char *aggregates = "aggregates", *coarse_factor = "factor";

struct SolverRow {
  std::size_t n_dofs = 0;
  double aspect = 0;
  int n_iterations = 0;
  std::string coarse_level;
  SolverFigures iterative;
  std::optional<SolverFigures> direct;  ///< nothing if it would not fit into memory
  fem::FactorSize factor{};             ///< of the direct one; nothing likewise
  double difference = 0;                ///< of the answers, largest of the load cases, relative
};

/// The solve alone: neither stresses nor the storage of responses.
/// @param n_repeats  of the iterative solve: the smallest CPU time counts
/// @throws std::runtime_error if the iterative solver gives up
SolverRow compare_solvers(const fem::Body& body, const std::vector<fem::UnitLoad>& loads, int n_repeats,
                          bool with_direct);

void print_heading();
void print_row(const SolverRow& row, std::size_t n_loads);

}  // namespace measure
