/// The cheapest model: a shaft as a Timoshenko beam with published stress concentration factors
/// at its fillets. Milliseconds. Eigen in the .cc files only, no deal.II.
#pragma once

#include <vector>

#include "fem/base/values/unit_load.h"
#include "fem/base/values/unit_responses.h"
#include "fem/models/beam/beam_shaft.h"

namespace fem {

/// Unit responses of the free shaft, in the same channels as the solid's: each load is balanced by the
/// inertia of the beam's own mass (fillets left out), displacements have no rigid part in the mass norm.
///
/// Internal forces are exact statics of the loads as unit_load.h distributes them; N / A, M r / I, T r / I_p
/// and the shear force's rim stress act about each section's own axis. Harmonics of seat pressure other than
/// the first carry nothing here, nor does the radial pull of spin. Sections stay plane (shear coefficient of
/// Cowper) and round; a displacement has no lateral contraction in it.
///
/// Nodes lie on circles: at both ends and in the middle of every piece of surface; at every fillet at its
/// foot, 15 degrees up its arc, where bending and tension peak, and at its top. The circle on the arc has the
/// nominal stress on the thinner diameter times fillet_factors, of a shoulder as high as it is at that angle
/// (around an eccentric seat it changes), and the hoop stress nu (K - 1) sigma that keeps the hoop strain
/// nominal. Bores count in the section, not in K. Faces connect the circles (VTK_BIQUADRATIC_QUAD, corners
/// counter-clockwise from outside); cells, sections and rings stay empty, nodal volumes zero.
/// @throws std::invalid_argument for a shaft without segments, with gaps or impossible sizes, a fillet
/// without a step, an empty list of loads, a body force on a part of the shaft
UnitResponses beam_responses(const BeamShaft& shaft, const std::vector<UnitLoad>& loads);

/// Largest relative change of a fillet's bending factor when the shoulder is as high as it really is at an
/// angle, instead of as high as with concentric segments; at least a quarter of the change of the height,
/// since bending also flows in from the thick segment's own axis. 0 without eccentric segments. It estimates,
/// for peaks at fillets, what concentric shoulders cost (axisymmetric_responses.h), and for the beam, which
/// takes the height at each angle, how far that may be off.
/// @throws std::invalid_argument as beam_responses
double eccentricity_error(const BeamShaft& shaft);

/// Estimate of the error of a peak stress at the fillets, relative: that of the bending factor and
/// eccentricity_error. Pressure right beside a fillet and sections that go oval are not in it.
double beam_model_error(const BeamShaft& shaft);

}  // namespace fem
