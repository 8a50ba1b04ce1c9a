/// Torsional stress between the rings of a section turned around the axis. Internal to the runs on this
/// model.
#pragma once

#include <map>
#include <string>

#include "fem/base/values/unit_responses.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/loads/channels/load_collector.h"

namespace pipelines {

/// Moves the ring with the largest torsional stress of each feature to where that is largest between the
/// rings: by the parabola through it and those beside it, half of the way to these at most, or on to the
/// border of what is left out beside a sharp edge. Places and responses of rings follow.
void move_rings_to_maxima(const BodyLoads& loads, const meshes::BodyMesh& mesh,
                          fem::UnitResponses& responses);

/// The largest ring of a feature, and what it may be more up to the border of what is left out (TorsionRing).
struct FeatureTorsion {
  double value_Pa = 0, rise_Pa = 0;
};

/// By feature. A ring where two of them meet counts to both, as nodes do.
std::map<std::string, FeatureTorsion> torsion_by_feature(const BodyLoads& loads,
                                                         const fem::UnitResponses& responses,
                                                         const meshes::BodyMesh& mesh);

}  // namespace pipelines
