/// The constants of fem/values/cost_constants.h, fitted anew to what the solvers took.
#pragma once

#include <string>
#include <vector>

#include "tests/benchmarks/solvers/solver_comparison.h"

namespace measure {

struct FittedConstant {
  std::string name;  ///< in cost_constants.h
  double table = 0;  ///< its value there
  double fitted = 0;
  std::size_t n_rows = 0;  ///< that it was fitted on
};

/// Least squares of relative differences, one group of constants after the other; what few rows cannot tell
/// is held at the table's value. Constants without a row are left out.
/// @param rows  of cells of degree 2
std::vector<FittedConstant> fit_costs(const std::vector<SolverRow>& rows, std::size_t n_loads);

/// Beside the table, and how far both are from the rows at worst.
void print_fit(const std::vector<SolverRow>& rows, std::size_t n_loads);

}  // namespace measure
