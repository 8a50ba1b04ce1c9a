/// How this machine's seconds compare with the predicted ones, learnt from every run.
#pragma once

#include <filesystem>
#include <string>

#include "fem/values/solver_choice.h"

namespace pipelines {

/// Measured over predicted seconds; 1 until something was measured.
struct CostCalibration {
  double direct = 1, iterative = 1, superposition = 1;
  int n_runs = 0;
  std::string fault;  ///< for the user, where the file is damaged; empty otherwise
};

/// $XDG_CACHE_HOME/millstress/costs.json, else ~/.cache/millstress/costs.json; empty if neither is known.
std::filesystem::path calibration_file();

/// What is kept there; the default where nothing is, or where the file's own checksum does not fit.
CostCalibration read_calibration(const std::filesystem::path& file);

/// Takes a run in: each factor moves half of the way, as a geometric mean. A file that cannot be written is
/// no failure: the next prediction is as good as this one.
/// @param solve_ratio, superposition_ratio  measured over predicted seconds; 0: not measured
void learn_cost(const std::filesystem::path& file, fem::Solver solver, double solve_ratio,
                double superposition_ratio);

/// Seconds that superposing so many nodes, instants and channels takes on the machine of the predictions.
double predicted_superposition_s(std::size_t n_nodes, std::size_t n_instants, std::size_t n_channels);

}  // namespace pipelines
