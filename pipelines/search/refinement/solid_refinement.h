/// Where the mesh of a body of tetrahedra becomes finer: all along the surface that may hold its largest
/// stress.
#pragma once

#include <string>
#include <vector>

#include "meshes/solids/solid_control.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/estimates/place_stress.h"

namespace pipelines {

/// About what so many unknowns of tetrahedra take to be solved and judged, on one core.
double seconds_of_tetrahedra(double n_dofs);

struct LeadingSurface {
  std::vector<meshes::FineSpot> spots;  ///< cells there become smaller by `ratio`
  std::vector<std::string> features;    ///< of the places that they lie on
  double ratio = 1;                     ///< of cell sizes, before : after
};

/// Balls of one and a half cells around every node of the surface whose own stress, with the relative error
/// of its place or the scatter of its cells, could be the largest of the body: around a fillet that is the
/// whole ring. A spot at the peak alone would only let the peak move along the ring, from one mesh to the
/// next.
/// @param judged  the places with their errors, not empty
/// @return nothing where no cell holds these nodes
LeadingSurface leading_surface(const Superposed& analysis, const std::vector<PlaceStress>& judged);

}  // namespace pipelines
