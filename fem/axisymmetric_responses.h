/// The middle rung of the ladder: a body of revolution by Fourier harmonics around the axis, each a plane
/// problem of its meridian. About a second for a shaft. deal.II in the .cc files only.
#pragma once

#include <vector>

#include "fem/meridian_body.h"
#include "fem/unit_load.h"
#include "fem/unit_responses.h"

namespace fem {

/// Unit responses of the free body in the channels of the solid, with the same balanced loads: f - M R
/// (R'MR)^-1 R'f, displacements without a rigid part in the mass norm. Only the harmonics that the loads have
/// are solved, one factorisation each; within a harmonic this is the elastic solution of the section.
///
/// Eccentric cylinders are concentric here: loads on them keep their resultants about the origin (the lever
/// of a force becomes a couple on its surface), their own mass likewise. Stiffness, and the height of the
/// shoulders beside them, do not follow; fem::eccentricity_error estimates what that costs at the fillets.
/// Stress that the eccentric cylinder makes by itself (spin) is off by its eccentricity over its radius.
///
/// Stress: derivatives of the displacement (degree 3: third order) at corners and middles of the surface's
/// edges, mean of the cells there. Nodes: those points on n_angles half planes, so a peak around is met to
/// 1 - cos(pi m / n_angles), 0.2 % at m = 1. Faces as in the solid's nodes; cells, sections and rings stay
/// empty, nodal volumes zero.
/// @throws std::invalid_argument for an empty list, what is not axisymmetric (a surface that is not in the
/// section, a body force on a part) naming the channel, and as meridian_grid.h
/// @throws SolveFailed if a factorisation fails
UnitResponses axisymmetric_responses(const MeridianBody& body, const std::vector<UnitLoad>& loads);

}  // namespace fem
