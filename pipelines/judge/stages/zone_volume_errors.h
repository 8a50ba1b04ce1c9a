/// What the volumes of a body's zones may be off by: how far the mesh leaves it open where the stress passes
/// the zones' level.
#pragma once

#include <vector>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// By how much the envelope of von Mises stress may be off at each node [Pa], the sum of
///   discretisation  at nodes that reach a fifth of the zones' level: the largest difference between
///                   recovered stress and single cells, and in cells at a place that is judged at
///                   least that place's share of error. Tetrahedra, whose single cells tell nothing at a
///                   node, have the largest share of the zones
///   the rest        of the numerical errors of the body's peak, as a share of the stress
///   the model       of harmonics: what they take eccentric segments for
std::vector<double> envelope_errors_Pa(const Judged& analysis);

/// Gives each zone the numerical error of its volume: the level stays as it is printed, and the stress is
/// moved up and down by envelope_errors_Pa. The connected regions above the level that hold the zone's peak
/// then are the largest and the smallest that the zone can be: all of two that may be one count in the
/// largest, none of a zone whose peak may be below the level in the smallest, which is joined node by node
/// where zones join across a whole cell. To this come one and a half times the differences of
/// the zone's cells between a stress that runs straight between nodes, and one that is curved
/// (fem/stress/cells/region_volume.h). A beam's zones have no volume, and no error.
void estimate_volume_errors(Judged& analysis);

}  // namespace pipelines
