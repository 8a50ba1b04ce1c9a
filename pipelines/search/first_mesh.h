/// The mesh that a search begins with.
#pragma once

#include <functional>

#include "pipelines/loads/body_mesh.h"

namespace pipelines {

struct FirstMesh {
  BodyScene body;  ///< with the fineness of the mesh
  MeshedBody meshed;
};

/// The first of first_meshes that the mesher takes. Of a STEP file, whose cells nobody knows before they are
/// there, and a limit of time: the first of ever coarser meshes that gmsh makes in 0.3 of the time that is
/// left and that is likely to be solved in the rest, or the last one that is much coarser than the one
/// before. Trials count: after one that took too long, and where there is no time for one, the coarsest mesh
/// is made, without which there would be no result.
/// @param mesh          makes the mesh of a body
/// @param seconds_left  of the search's time; infinite without a limit
/// @throws what `mesh` throws of the body's own mesh
FirstMesh first_mesh(const BodyScene& body, const std::function<MeshedBody(const BodyScene&)>& mesh,
                     const std::function<double()>& seconds_left);

}  // namespace pipelines
