/// The list `effects` of a scene: known names, none twice, none without what it needs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipelines/scene_table.h"

namespace pipelines {

/// An effect that makes no sense without another one.
struct EffectNeed {
  std::string effect, needed, reason;
};

/// An effect that is known, but not in this scene.
struct EffectRefusal {
  std::string effect, remedy;
};

/// What a machine's scene may name.
struct EffectRules {
  std::vector<std::string> known;
  std::vector<EffectNeed> needs;
  std::vector<EffectRefusal> refused;
  std::vector<std::string>
      lacking{};  ///< the scene does not give their data: "all" and "auto" pass over them
};

/// Effects of kinetics under the convention, then those that come from the shaft's mesh; what is known under
/// the other convention only, or needs a shaft that the scene lacks, is refused with that reason.
EffectRules vibratory_mill_rules(kinetics::Convention convention, bool has_shaft);

/// The one effect that has two names under the planetary mill's conventions is refused under the wrong one.
EffectRules planetary_mill_rules(kinetics::PlanetaryConvention convention);

/// Adds the effects that a body of that role brings; without the body they are refused, naming its table.
void add_own_effects(EffectRules& rules, BodyRole role, bool has_body, const std::string& table);

/// Any of the names, each by itself.
EffectRules plain_rules(const std::vector<kinetics::EffectInfo>& effects);

/// Reads `effects` of the root table into scene.effects: a list of names, as written, each known, none twice;
/// or "all", every effect that the scene has data for; or "auto", the same with the choice left open
/// (effect_choice.h). Errors go to the findings.
void read_effects(SceneTable& root, const EffectRules& rules, Scene& scene, SceneFindings& findings);

}  // namespace pipelines
