/// Edges of a CAD part that are rounded before it is meshed, for the effective notch stress of welds.
#pragma once

#include <vector>

#include "meshes/imported/import.h"
#include "meshes/solids/model_mesh.h"

namespace meshes {

/// What an edge became.
struct RoundedEdge {
  std::vector<int> surfaces;    ///< tags of the rounding's surfaces
  std::vector<Point> course_m;  ///< points along the edge as it was
};

/// Rounds in gmsh's current model of one solid the inner edge next to each notch, with all edges that go on
/// from it without a kink. Numbers of surfaces change.
/// @param unit_m  length of the model's unit
/// @return one entry per notch
/// @throws GeometryRefused naming the notch and the remedy: no edge within five radii, an outer edge, several
/// solids, an edge that OpenCASCADE does not round
std::vector<RoundedEdge> round_edges(const std::vector<PartNotch>& notches, double unit_m);

/// Puts the notches into the pieces that are their surfaces: "effective notch 1, fillet r 1 mm".
/// @param rounded  the notches' edges, in their order
void name_notches(const std::vector<PartNotch>& notches, const std::vector<RoundedEdge>& rounded,
                  ModelMesh& model);

}  // namespace meshes
