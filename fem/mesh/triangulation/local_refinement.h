/// Local refinement of a deal.II mesh, and what hangs after it. Internal to fem.
#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/tria.h>

#include <cstdint>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// Cuts cells into eight, cycle after cycle; more where levels would differ by more than one across a face,
/// an edge or a vertex. New vertices lie on the manifolds.
/// @throws std::invalid_argument for an index that is no cell, a point without vertex
void refine_locally(dealii::Triangulation<3>& mesh, const std::vector<RefinementCycle>& cycles);

/// Larger cells that share a vertex with one of these, ascending.
/// @param cells  indices of active cells
std::vector<std::int32_t> larger_neighbours(const dealii::Triangulation<3>& mesh,
                                            const std::vector<std::size_t>& cells);

/// Numbers of the nodes of a scalar space on a mesh that may have hanging nodes.
struct NodeNumbers {
  std::vector<std::int32_t> of_dof;  ///< a vertex in the middle of a larger cell's edge or face is that
                                     ///< cell's node there
  std::size_t n_nodes = 0;
  HangingNodes hanging;
};
NodeNumbers number_nodes(const dealii::DoFHandler<3>& space);

}  // namespace fem
