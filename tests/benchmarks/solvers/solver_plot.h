/// A picture of the solvers' figures against the number of unknowns.
#pragma once

#include <filesystem>
#include <vector>

#include "tests/benchmarks/solvers/solver_comparison.h"

namespace measure {

/// Two panels, CPU seconds and bytes, both axes logarithmic; beside the points a line of constant cost per
/// unknown through the second iterative one.
/// @throws std::runtime_error if the file cannot be written
void write_solver_plot(const std::filesystem::path& svg, const std::vector<SolverRow>& rows);

}  // namespace measure
