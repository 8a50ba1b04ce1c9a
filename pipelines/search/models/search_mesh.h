/// The meshes of a search: the first one, and finer ones in the time that is left.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/judge/estimates/search_record.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Meshes a body, as the stage "mesh".
/// @param scene   whose springs may hold it
/// @param coarse  the same mesh with fewer refinements; null: there is none
MeshedBody mesh_in_stage(const Scene& scene, const BodyScene& body, const MeshedBody* coarse,
                         StageClock& clock);

struct SearchMesh {
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
SearchMesh first_mesh(const BodyScene& body, const std::function<MeshedBody(const BodyScene&)>& mesh,
                      const std::function<double()>& seconds_left);

/// The mesh of a body that a search has refined. Where the mesher refuses one of tetrahedra, one nearly as
/// fine; each as long as there is time.
/// @param mesh          makes the mesh of a body, and may cut more of its cells (mesh_refined)
/// @param seconds_left  for meshing; infinite without a limit
/// @param refusal       what the mesher says of the body's own mesh
/// @return none that it takes, or no time
std::optional<SearchMesh> finer_mesh(const BodyScene& body, const std::function<MeshedBody(BodyScene&)>& mesh,
                                     const std::function<double()>& seconds_left, std::string& refusal);

/// Tells that the search of a user's own file ended with its first mesh, long after its limit of time; else
/// empty. One mesh has to be solved for a result, and that may take longer than there is.
/// @param end_s  limit of time, from the start of the run; 0: none
std::string warning_of_overrun(const BodyScene& body, const Search& search, double end_s, double now_s);

}  // namespace pipelines
