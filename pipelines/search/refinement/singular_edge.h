/// Where stress grows without bound: the concave edge or that of a load, found on the surface of a mesh.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// All edges that join the node, from face to face, along which the surface has a concave kink of more than
/// 15 degrees, or at which a loaded or held surface ends: the whole rim of a shoulder, not the one place
/// where its stress was largest. Kinks are those of the curved faces (degree 2), so that a fillet of few
/// cells has none.
/// @param reach_m  how far from the edge the node may be: coarse cells have their largest stress beside it
/// @param loaded   boundary ids of the surfaces that carry loads or are held
/// @return segments [m], end to end; empty if there is no such edge, or for cells of another degree
std::vector<std::array<std::array<double, 3>, 2>> singular_edge_through(const fem::Nodes& nodes,
                                                                        std::size_t node, double reach_m = 0,
                                                                        const std::set<int>& loaded = {});

/// What is left out around a peak that grows with every refinement: the whole edge through it, by a distance
/// that stays with the geometry.
struct EdgeWithoutBound {
  meshes::SharpEdge edge;
  std::string warning;
};
/// @return nothing where no edge is near: in the middle of a face, and on fillets, stress has a bound,
/// however long coarse cells find more of it
std::optional<EdgeWithoutBound> edge_without_bound(const Judged& analysis);

}  // namespace pipelines
