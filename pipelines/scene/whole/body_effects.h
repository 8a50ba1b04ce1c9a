/// Effects that bodies add to those of their machine, and what the equilibrium of a body needs of both: the
/// counterpart of the machines' tables in kinetics (coupling of loads and bodies, sections 2 to 6).
#pragma once

#include <string>
#include <vector>

#include "kinetics/values/effect_info.h"
#include "pipelines/scene/values/body_scene.h"
#include "pipelines/scene/whole/machine.h"

namespace pipelines {

struct Scene;

/// Effects that a body adds, its own and those of its options.
std::vector<kinetics::EffectInfo> body_effect_table(const BodyScene& body);

/// Every effect that a scene's machine and its bodies know, each with what it needs there. A machine's effect
/// may need one of a body's: where a shaft of a drive train is a body, a torque that varies accelerates it,
/// as a start does, and `shaft_inertia` is what balances that.
/// @param scene  with machine and bodies read
std::vector<kinetics::EffectInfo> effect_table(const Scene& scene);

}  // namespace pipelines
