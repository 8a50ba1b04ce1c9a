/// Recovery-based error estimate (Zienkiewicz and Zhu, Int. J. Numer. Meth. Engng 24, 1987): the recovered
/// stress stands for the exact one. Internal to fem.
#pragma once

#include <mpi.h>

#include "fem/base/values/unit_responses.h"
#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/grid/mirror_plane.h"
#include "fem/stress/cells/cell_stress.h"

namespace fem {

/// @param displacement  n_nodes x 3 K
/// @param stress        recovered, n_nodes x 6 K
/// @param plane         if both are mirror images in it: half of the cells tell of all
EnergyError energy_error(const Grid& grid, const PerCell<Lame>& elastic, const ConstBlock& displacement,
                         const ConstBlock& stress, const MirrorPlane* plane = nullptr);

/// The same where each rank has its cells, and those that their nodes hang on. Called on all ranks.
/// @param part  the cells without stiffness are others'
/// @param displacement, stress  at the nodes of the part
/// @return of the whole body
EnergyError energy_error_on_ranks(MPI_Comm communicator, const StiffnessShare& part, std::size_t n_cells,
                                  const ConstBlock& displacement, const ConstBlock& stress);

}  // namespace fem
