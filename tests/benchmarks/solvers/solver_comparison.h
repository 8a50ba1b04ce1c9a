/// The load cases of a body by both solvers: what each takes.
#pragma once

#include <optional>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/solver_choice.h"
#include "fem/base/values/unit_load.h"

namespace measure {

struct SolverFigures {
  double cpu_s = 0;         ///< from the mesh and the loads to the displacements
  double bytes = 0;         ///< largest resident memory of the whole process meanwhile
  double bytes_before = 0;  ///< of these: mesh, loads, program
  fem::SolverCost predicted{};
};

struct SolverRow {
  std::size_t n_dofs = 0, n_loads = 0;
  double aspect = 0;
  int n_iterations = 0;
  SolverFigures iterative;
  std::optional<SolverFigures> direct;  ///< nothing if it does not fit into memory
  double difference = 0;                ///< of the answers, largest of the load cases, relative
};

/// The solve alone, neither stresses nor the storage of responses. Up to twelve loads that do not vanish once
/// they are balanced.
SolverRow compare_solvers(const fem::Body& body, const std::vector<fem::UnitLoad>& loads);

void print_heading();
void print_row(const SolverRow& row);

}  // namespace measure
