/// The middle model between beam and solid: a body of revolution by Fourier harmonics around the axis, each a
/// plane problem of its meridian. About a second for a shaft. deal.II in the .cc files only.
#pragma once

#include <vector>

#include "fem/base/values/unit_load.h"
#include "fem/base/values/unit_responses.h"
#include "fem/models/axisymmetric/meridian_body.h"

namespace fem {

/// Unit responses of the free body in the channels of the solid, with the same balanced loads: f - M R
/// (R'MR)^-1 R'f, displacements without a rigid part in the mass norm. Only the harmonics that the loads have
/// are solved, one factorisation each; within a harmonic this is the elastic solution of the section.
///
/// Eccentric cylinders are concentric here: loads on them keep their resultants about the origin (the lever
/// of a force becomes a couple on its surface), their own mass likewise. Stiffness, and the height of the
/// shoulders beside them, do not follow; fem::eccentricity_error estimates what that costs at the fillets.
/// Nor is there the bending by an axial force beside the cylinder's axis, nor twist about that axis.
/// Stress that the eccentric cylinder makes by itself (spin) is off by its eccentricity over its radius.
///
/// Stress: derivatives of the displacement (degree 3: third order), mean of the cells at a point. Nodes: the
/// corners and middles of the surface's edges, corners and centres of the cells there as they are cut, and
/// the corners of larger cells inside, on n_angles half planes. So a peak around is met to
/// 1 - cos(pi m / n_angles), 0.2 % at m = 1. On the axis there is one node, with one tensor.
/// Cells and faces have degree 1 and only show the result (revolved_nodes.h): no stress can be recovered from
/// them. Sections, rings and resultants are those of the solid; `energy_error` stays empty.
/// @param planes  lines of cell edges through the whole wall
/// @throws std::invalid_argument for an empty list, what is not axisymmetric (a surface that is not in the
/// section, a body force on a part) naming the channel, and as meridian_grid.h
/// @throws SolveFailed if a factorisation fails
UnitResponses axisymmetric_responses(const MeridianBody& body, const std::vector<UnitLoad>& loads,
                                     const std::vector<SectionPlane>& planes = {});

/// Mass, first and second moments of the section turned around the axis, by the quadrature of its body
/// forces, and of the eccentric cylinders' offsets.
MassProperties axisymmetric_masses(const MeridianBody& body);

}  // namespace fem
