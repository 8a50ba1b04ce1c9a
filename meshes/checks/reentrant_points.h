/// Points at which a hollow comes to a tip, found by looking at a mesh's boundary.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "meshes/values/body_mesh.h"

namespace meshes {

/// Adds the tips of hollows, as a drill or a centre leaves them: vertices of the boundary from which all of
/// it rises towards the outside within 70 degrees of one direction, which leaves out smooth hollows of ten
/// cells around and more. Stress rises towards the tip of a conical notch without bound, if weakly, and no
/// cell shows it. Tips on the edges given are passed over, but for edges within one surface, of which what
/// begins or ends at a tip is taken away: it is a kink between the few cells around the tip. One entry each,
/// named "tip of <surface>", with one piece of no length.
/// @param names  names of the surfaces by id
/// @param edges  reentrant_edges of the same mesh
void add_reentrant_points(const CellMesh& mesh, const std::map<int, std::string>& names, double distance_m,
                          std::vector<SharpEdge>& edges);

}  // namespace meshes
