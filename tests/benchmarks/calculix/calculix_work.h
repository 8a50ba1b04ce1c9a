/// The parts of the benchmark beside CalculiX that run as processes of their own, so that each one's memory
/// is its own. Each prints lines "name value".
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/scene/whole/scene.h"

namespace measure {

inline constexpr int n_threads = 2;

/// What a process works on.
struct Work {
  pipelines::BodyScene body;
  std::filesystem::path directory;  ///< mesh, shaft.inp, shaft.frd
};

/// shaft.inp; prints our unknowns and those of the model for CalculiX.
void write_model(const Work& work);

/// Mesh file to stresses, written to unit_responses.h5; prints seconds and CPU seconds of the whole and of
/// assembly and solution alone.
void solve(const Work& work, fem::Solver solver);

/// Our direct path with and without assembly, and bare CHOLMOD on the same matrix and right-hand sides;
/// prints ratios of the smallest wall and CPU seconds of three turns.
void factorise(const Work& work);

/// Our solution beside CalculiX's shaft.frd: prints a table.
void compare(const Work& work);

}  // namespace measure
