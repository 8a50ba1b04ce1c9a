/// The stress of a place on the border of the exclusion distances, where no node need lie.
#pragma once

#include "pipelines/analysis/body_analysis.h"
#include "pipelines/analysis/place_stress.h"

namespace pipelines {

/// By how much the place's stress may be larger between its nodes and the border of the exclusion distances:
/// there it is read off the chord from a node outside to the next one within, on the faces of the place,
/// inside the body on the cells. Stress grows towards a sharp edge ever faster, so the chord lies above it.
/// Nothing where a row of nodes lies on the border.
/// @return [Pa], at least 0
double rise_to_border_Pa(const BodyAnalysis& analysis, const PlaceStress& place);

}  // namespace pipelines
