/// What solving a body will take, before anything is solved.
#pragma once

#include <cstddef>

#include "fem/values/body.h"
#include "fem/values/solver_choice.h"

namespace fem {

/// The solver that Model::unit_responses would take for so many unit loads, why, and what both are predicted
/// to need (SolverReport::predicted): seconds of a machine of 2025 with two threads, bytes. Reads the mesh.
/// @throws as Model for the mesh; std::runtime_error if no solver would fit into this machine's memory
SolverReport predict_solver(const Body& body, std::size_t n_loads, const SolverChoice& choice);

/// The same for another number of unknowns in cells of the same shape, degree and material.
/// @param at_hand  of a mesh of that body
SolverReport predict_solver(const SolverReport& at_hand, std::size_t n_dofs, int degree, std::size_t n_loads,
                            const SolverChoice& choice);

}  // namespace fem
