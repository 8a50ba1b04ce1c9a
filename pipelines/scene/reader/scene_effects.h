/// The list `effects` of a scene: known names, none twice, none without what it needs. Which effects there
/// are and what they need is said by the tables of kinetics and of body_effects.h.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

/// An effect that is known, but not in this scene.
struct EffectRefusal {
  std::string effect, remedy;
};

/// What a machine's scene may name.
struct EffectRules {
  std::vector<kinetics::EffectInfo> table;
  std::vector<EffectRefusal> refused{};
  /// The scene does not give their data: "all" and "auto" pass over them, and over what needs them.
  std::vector<std::string> lacking{};
};

/// Names of the effects, each once.
std::vector<std::string> names_of(const std::vector<kinetics::EffectInfo>& table);
bool has_effect(const std::vector<kinetics::EffectInfo>& table, const std::string& name);

/// Adds the effects that the bodies of a machine bring; those of a body that the scene lacks are refused,
/// naming its table.
void add_own_effects(EffectRules& rules, const std::string& machine_type, const SceneTable& root);

/// Reads `effects` of the root table into scene.effects: a list of names, as written, each known, none twice;
/// or "all", every effect that the scene has data for; or "auto", the same with the choice left open
/// (effect_choice.h). Fills scene.effects_key. Errors go to the findings.
void read_effects(SceneTable& root, const EffectRules& rules, Scene& scene, SceneFindings& findings);

}  // namespace pipelines
