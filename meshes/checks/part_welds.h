/// Weld toes of parts: where hot-spot stress is read beside a sharp inner edge that is welded.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "meshes/values/body_mesh.h"

namespace meshes {

/// A sharp inner edge of a part that the scene says is a weld.
struct PartWeld {
  Point at_m{};            ///< next to the edge: the nearest one is meant
  double thickness_m = 0;  ///< thickness of the plate whose stress counts
};

struct PartToes {
  std::vector<HotSpot> hot_spots;
  std::vector<std::string> covered;  ///< names of toes beside which a face ends before both points
};

/// Places along the sharp edge nearest to the point, on both of its faces, at most a plate thickness apart,
/// the same on every mesh: the toe, and the points at 0.4 and 1.0 plate thicknesses from it along the face,
/// across the edge. The edge keeps as much out of the peak as a plate is thick.
/// @param number  number of the weld among those of the part, for the names of its toes
/// @param edges   edges of the mesh (reentrant_edges); that of the weld gets its distance
/// @throws GeometryRefused if no sharp edge is within a plate thickness of the point, or the mesh is none of
/// tetrahedra
PartToes place_weld_toes(const CellMesh& mesh, const std::map<int, std::string>& names, const PartWeld& weld,
                         int number, std::vector<SharpEdge>& edges);

}  // namespace meshes
