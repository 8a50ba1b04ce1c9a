/// Edges of a mesh that are sharp and re-entrant, found by looking at its boundary.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "meshes/values/body_mesh.h"

namespace meshes {

/// Edges where two boundary faces meet with their outward normals more than 60 degrees apart and the corner
/// turned into the material: one entry per pair of features, "<one>/<other>". Fillets with six cells per
/// circle and more stay below 60 degrees.
std::vector<SharpEdge> reentrant_edges(const CellMesh& mesh, const std::map<int, std::string>& names,
                                       double distance_m);

/// Length of the box around the mesh from corner to corner.
double diagonal_m(const CellMesh& mesh);

}  // namespace meshes
