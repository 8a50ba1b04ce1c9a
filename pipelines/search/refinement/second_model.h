/// Harmonics around the axis as a second model beside a shaft of solid cells: it tells where the mesh has to
/// be fine before anything is solved, and what the solid's stresses have to agree with.
#pragma once

#include <optional>

#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/search/refinement/place_history.h"

namespace pipelines {

/// Stresses of all places of a shaft by the axisymmetric model. On concentric shafts, where it solves the
/// same problem, to a tenth of the tolerance (between 0.2 and 1 % of the largest stress), with the errors of
/// its section and what nodes at a distance around the axis can miss of a peak between them. On others it is
/// a guide, with an error of its own that no section lowers: one section, whose stresses are taken to be
/// known to 5 %.
/// @param tolerance  of the search, relative; 0: as well as it can
/// @return nothing for bodies that the model does not apply to
std::optional<SecondModel> axisymmetric_second_model(const BodyScene& body, const MeshedBody& meshed,
                                                     const BodyLoads& loads, double tolerance, int n_threads);

}  // namespace pipelines
