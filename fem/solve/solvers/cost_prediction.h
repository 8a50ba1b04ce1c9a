/// What solving a body will take on a mesh that is not made: from one that is (Model::predict_solver), or by
/// formula.
#pragma once

#include <cstddef>

#include "fem/base/values/solver_choice.h"

namespace fem {

/// Model::predict_solver for another number of unknowns in cells of the same shape, degree and material.
/// @param at_hand  of a mesh of that body
SolverReport predict_solver(const SolverReport& at_hand, std::size_t n_dofs, int degree, std::size_t n_loads,
                            const SolverChoice& choice);

/// By the number of unknowns alone, where there is no mesh: of the direct solver within a factor of three,
/// since thin walls take less than the shafts and rods that the formula is fitted on.
/// @param tetrahedra  whether the cells are; else hexahedra of a usual stretch
SolverReport predict_solver(std::size_t n_dofs, int degree, bool tetrahedra, std::size_t n_loads,
                            const SolverChoice& choice);

}  // namespace fem
