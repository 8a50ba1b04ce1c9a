/// The model error of load patches: how far the largest stresses depend on the assumed shape of the seat
/// pressures.
#pragma once

#include "pipelines/analysis/body_analysis.h"

namespace pipelines {

/// How much narrower and wider a seat's contact is taken than the scene's half angle: clearance and
/// interference move it, and no calculation here knows them.
inline constexpr double contact_variation = 0.25;

/// The pattern with its half angle times `factor`, at most all round (a uniform one: half way to that, where
/// it would lose its resultant).
PressurePattern with_contact(PressurePattern pattern, double factor);

/// Adds the entry `load_patches` to the model part of the budgets of peak and hot-spot stress: the largest
/// change of that stress when all seat pressures of the body reach 25 % less or more far round. The
/// resultants stay, only the Fourier coefficients of the harmonics n = 0, 2, 3 ... change, and these are
/// factors of responses that are solved already. A harmonic that the scene's pattern has not (n = 3 of a
/// half-cosine) was not solved: what it would bring to the governing point is estimated from its neighbours'
/// stresses and added.
///
/// Nothing else is varied: forces on faces and added masses act on their whole port, whose size the scene
/// gives. A body without seat pressures, or whose governing stress does not feel them, gets no entry.
void add_load_patch_error(BodyAnalysis& analysis);

}  // namespace pipelines
