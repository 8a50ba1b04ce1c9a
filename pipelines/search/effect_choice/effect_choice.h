/// `effects = "auto"`: switches off what matters little to the bodies of a scene, before anything is solved.
#pragma once

#include <string>
#include <vector>

#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// What may change when effects are switched off: a tenth of the tolerance, of 5 % where none is asked for.
double negligible_share(double tolerance);

/// Sum of forces [N] and moment about the origin [N m] of one unit of a channel. Pressure harmonics count
/// with their coefficients, and spin, whose parts balance each other, with the largest sum of forces that its
/// mass and polar inertia allow, sqrt(m J) (Cauchy and Schwarz).
struct UnitSize {
  double force = 0, moment = 0;
};
UnitSize size_of_unit(const fem::UnitLoad& load, const std::vector<RegionMass>& regions);

/// How much of a body's loads two sets of channels differ by: the sum over the channels of |difference| times
/// the force (moment) of one unit, largest over the instants, over the same sum of the loads themselves; the
/// larger of forces and moments.
/// @param all  what the difference is measured by
/// @return 0 where nothing differs; infinite where something does and `all` is nothing
double share_of_loads(const BodyLoads& all, const BodyLoads& other, const std::vector<RegionMass>& regions);

/// Settles an open choice: from the least to the most important, effects go off as long as leaving out all of
/// them together changes the loads on no body, nor the load of a bearing whose life is asked for, by more
/// than the limit. The load stage and the distribution to the bodies are run anew without them, so that
/// effects that build on each other or cancel are judged by what remains. Effects that need each other, by
/// their tables or for the equilibrium of a body, go together or stay: every set that is tried as a choice is
/// admissible (effect_closure.h). Which loads beyond the bodies change (a weight that the springs carry) is
/// noted, not judged. No clock takes part.
///
/// A load table's histories are all kept: the user put them there. Without bodies every load of the load
/// stage counts, each measured by itself (report_effects).
/// @param meshed  in the order of scene.bodies; empty: judge by the loads alone
/// @return the scene as it is if its choice is not open
/// @throws SceneError if all effects together leave a body without equilibrium
Scene with_effects_chosen(Scene scene, const std::vector<MeshedBody>& meshed, double limit);

/// Whether no effect of the scene lacks another one that it makes no sense without (effect_table).
bool has_what_it_needs(const Scene& scene);

/// The scene with a dropped effect on again, with those that went in the same step and what they need; noted
/// as taken back.
Scene with_effect_back(Scene scene, const std::string& effect);

/// The scene with exactly these of its offered effects on.
Scene with_effects(Scene scene, const std::vector<std::string>& effects);

}  // namespace pipelines
