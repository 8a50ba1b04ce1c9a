/// The stress of a place on the border of the exclusion distances, where no node need lie.
#pragma once

#include <vector>

#include "fem/values/unit_responses.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/analysis/body_analysis.h"
#include "pipelines/estimates/place_stress.h"
#include "pipelines/superposition/zones.h"

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
double rise_to_border_Pa(const BodyAnalysis& analysis, const PlaceStress& place);

/// Whether a sharp edge is so near that the cells there disturb the stress at the point.
bool is_at_border(const meshes::BodyMesh& mesh, const std::array<double, 3>& point_m);

/// How many cells of a shaft, as long as the largest at the place's maximum, would fit between a sharp edge
/// beside it and the border of what is left out there; 0 where no edge is near or no face is at the maximum.
double cells_to_border(const BodyAnalysis& analysis, const PlaceStress& place);

}  // namespace pipelines
