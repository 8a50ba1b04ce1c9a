/// What solving a body will take on a mesh that is not made, from one that is (Model::predict_solver).
#pragma once

#include <cstddef>

#include "fem/values/solver_choice.h"

namespace fem {

/// Model::predict_solver for another number of unknowns in cells of the same shape, degree and material.
/// @param at_hand  of a mesh of that body
SolverReport predict_solver(const SolverReport& at_hand, std::size_t n_dofs, int degree, std::size_t n_loads,
                            const SolverChoice& choice);

}  // namespace fem
