/// Where stress grows without bound: the concave edge, found on the surface of a mesh.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fem/values/unit_responses.h"
#include "pipelines/analysis/body_analysis.h"

namespace pipelines {

/// All edges that join the node, from face to face, along which the surface has a concave kink of more than
/// 15 degrees: the whole rim of a shoulder, not the one place where its stress was largest. Kinks are those
/// of the curved faces (degree 2), so that a fillet of few cells has none.
/// @param reach_m  how far from the edge the node may be: coarse cells have their largest stress beside it
/// @return segments [m], end to end; empty if there is no such edge, or for cells of another degree
std::vector<std::array<std::array<double, 3>, 2>> concave_edge_through(const fem::Nodes& nodes,
                                                                       std::size_t node, double reach_m = 0);

/// What is left out around a peak that grows with every refinement: the whole concave edge through it, else
/// the peak alone, by a distance that stays with the geometry.
struct SpotWithoutBound {
  meshes::SharpEdge spot;
  std::string warning;
};
SpotWithoutBound spot_without_bound(const BodyAnalysis& analysis);

}  // namespace pipelines
