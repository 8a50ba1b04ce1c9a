/// The stress of a place on the border of the exclusion distances, where no node need lie.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {

/// What is looked at; refers to what has to outlive it.
struct StressBesideEdges {
  const fem::Nodes& nodes;
  const std::vector<double>& von_mises_Pa;  ///< n, largest over the cycle
  const NodePlaces& places;                 ///< of these nodes beside the mesh's sharp edges
  const meshes::BodyMesh& mesh;             ///< features and sharp edges
};

/// By how much the place's stress may be larger between its nodes and the border of the exclusion distances:
/// there it is read off the chord from a node outside to the next one within, on the faces of the place,
/// inside the body on the cells. Stress grows towards a sharp edge ever faster, so the chord lies above it.
/// Nothing where a row of nodes lies on the border.
/// @return [Pa], at least 0
double rise_to_border_Pa(const StressBesideEdges& body, const PlaceStress& place);
double rise_to_border_Pa(const Superposed& analysis, const PlaceStress& place);

/// The largest stress of the surface on the border of the exclusion distances, read like rise_to_border_Pa,
/// and at the nodes next to it; 0 where nothing is left out.
double largest_at_border_Pa(const Superposed& analysis);

/// The sharp edge towards which the peak rises: the peak is on the border of what is left out, or a face that
/// it is on has a larger stress nearer to the edge. Null: none.
const meshes::SharpEdge* edge_beside_peak(const Judged& analysis);

/// Distance of a point to the nearest border of the exclusion distances [m]: negative within; the largest
/// number of a body without sharp edges.
/// @param boundary_id  of the surface that the point lies on, whose own distances count; none: inside
double beyond_border_m(const meshes::BodyMesh& mesh, const std::array<double, 3>& point_m,
                       std::optional<int> boundary_id);

/// Whether a sharp edge is so near that the cells there disturb the stress at the point.
bool is_at_border(const meshes::BodyMesh& mesh, const std::array<double, 3>& point_m);

/// How many cells, as long as the largest at the place's maximum, would fit between a sharp edge beside it
/// and the border of what is left out there; 0 where no edge is near or no face is at the maximum. Of
/// hexahedra on shafts, and of tetrahedra, of which the maximum may lie a whole cell beyond the border.
double cells_to_border(const Superposed& analysis, const PlaceStress& place);

}  // namespace pipelines
