/// Series of meshes of one body whose cells shrink together, for the grid convergence index.
#pragma once

#include <vector>

#include "fem/base/values/unit_responses.h"
#include "pipelines/scene/values/body_scene.h"

namespace pipelines {

/// Levels of the series: cells of level n are n times smaller than those of a level 1.
inline constexpr int systematic_levels[] = {2, 3, 4, 6};

/// The body's mesh at a level. Shafts: 2 n cells on fillet quarters and 8 n sectors, or a whole multiple of
/// these where level 4 would be coarser than the scene; all of one layout, whose cells are cut into n along
/// every edge (meshes::ShaftMeshControl::subdivisions), so that the numbers of cells are as n^3. Chambers: n
/// / 2 of the scene's cells through the wall, at the toes and elsewhere (odd levels need an even number of
/// cells through the wall: it becomes one). Tetrahedra: sizes in proportion to 4 / n of the scene's.
BodyScene systematic_mesh(const BodyScene& body, int level);

/// (volume / number of cells)^(1/3) [m].
/// @throws std::invalid_argument for nodes without cells
double cell_size_m(const fem::Nodes& nodes);

}  // namespace pipelines
