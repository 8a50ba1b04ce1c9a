/// Which sets of effects leave the bodies of a scene in equilibrium. A set is admissible if no effect lacks
/// one that it needs (effect_table), something loads every body, and the loads on each close: forces, moments
/// and the channels' own resultants to Closure::limit. What moves a body needs the inertia that balances it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/loads/channels/closure.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/loads/stage/machine_masses.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// The loads of a scene on its bodies under some of its effects.
struct EffectTrial {
  kinetics::LoadHistory history;
  std::vector<BodyLoads> bodies;  ///< in the order of Scene::bodies
};

/// The load stage and the distribution to the bodies, with the scene's effects.
/// @param meshed  in the order of scene.bodies; may be empty: the load stage alone
/// @throws std::invalid_argument as they do
EffectTrial try_effects(const Scene& scene, const std::vector<MeshedBody>& meshed,
                        const MassAgreement& masses);

/// Closure from ports and masses alone, without a solve.
Closure closure_of(const BodyLoads& loads, const std::vector<RegionMass>& regions);

/// Effects of which the own loads leave a resultant on the body, above Closure::limit of all loads on it.
std::vector<std::string> unbalanced_effects(const BodyLoads& loads, const std::vector<RegionMass>& regions);

/// Whether the trial's loads are there and close on every body.
bool is_admissible(const EffectTrial& trial, const std::vector<MeshedBody>& meshed);

/// Effects that are off together, and the loads without them.
struct ClosedSet {
  std::vector<std::string> off;  ///< in the order of the scene's effects
  EffectTrial trial;
};

/// The smallest set of effects, found by their needs and by what the bodies' equilibrium lacks without them,
/// that can be off together with `off`. Empty: there is none, or no effect of the machine would be left.
/// @param scene  with all effects that may be on
std::optional<ClosedSet> closed_set(const Scene& scene, const std::vector<MeshedBody>& meshed,
                                    const MassAgreement& masses, std::vector<std::string> off);

/// Refuses effects that leave a body without loads or without equilibrium.
/// @throws SceneError at the key `effects`, saying what is left over and which effects to add or remove
/// @throws std::runtime_error where no choice of effects would help
void require_equilibrium(const Scene& scene, const std::vector<MeshedBody>& meshed,
                         const MassAgreement& masses, const std::vector<BodyLoads>& loads);

}  // namespace pipelines
