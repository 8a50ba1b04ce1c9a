/// What the effects that `effects = "auto"` has switched off could change at most in a body's stresses.
#pragma once

#include <string>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/loads/stage/load_stage.h"

namespace pipelines {

/// Fills analysis.dropped and enters the bound of all dropped effects together as `dropped_effects` into the
/// model part of the budgets of peak and hot-spot stress.
///
/// Stress is linear in the channels and von Mises stress is a norm, so no point's stress moves by more than
/// the von Mises stress of the dropped part of the loads there: the loads with the effects less the loads
/// without, superposed with the responses that were solved. An effect by itself, with those
/// that went in the same step, is bounded by switching it on alone, or off alone where it needs another
/// dropped one. Of what acts on channels that were not solved:
/// - acceleration of the whole body as a rigid one makes no stress: the balancing forces are the load itself;
/// - the rest (spin, acceleration of a part) is estimated as the sum of its forces at that port where a force
///   stresses the point most, moments likewise; `estimated_Pa` tells how much of the bound that is.
/// @param index  of the body in Scene::bodies
void bound_dropped_effects(const Loaded& loaded, std::size_t index, Judged& analysis);

/// The dropped effect that has to come back: where the dropped ones together may move a governing stress by
/// more than the limit, the one with the largest bound. Empty: none.
std::string effect_to_take_back(const Scene& scene, const std::vector<Judged>& analyses);

}  // namespace pipelines
