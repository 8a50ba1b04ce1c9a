#include "pipelines/scene/values/effect_groups.h"

#include <algorithm>

#include "pipelines/base/names/name_lists.h"

namespace pipelines {
namespace {

/// Groups in the order of the output. Names are those of the tables of kinetics and of own_effects of the
/// bodies.
const std::vector<EffectGroup>& known_groups() {
  static const std::vector<EffectGroup> groups = {
      {"weights",
       {"gravity_structure", "gravity_exciter", "gravity_charge", "gravity_debalance", "gravity_shaft",
        "drum_gravity", "charge_gravity"}},
      {"inertia of the charge",
       {"charge_translation", "charge_centripetal", "charge_coriolis", "charge_relative", "charge_lag",
        "charge_follows_pitch", "charge_transport", "charge_offset"}},
      {"inertia of the chamber", {"structure_inertia", "exciter_inertia", "pitch"}},
      {"inertia of the drum", {"drum_transport", "drum_spin"}},
      {"inertia of the shaft", {"shaft_inertia"}},
      {"springs", {"springs", "spring_damping"}},
      {"debalances", {"debalance_inertia"}},
      {"belt", {"belt"}},
      {"guides", {"pitch_guide", "drive_couple"}},
  };
  return groups;
}

}  // namespace

std::vector<EffectGroup> effect_groups(const std::vector<std::string>& effects) {
  std::vector<EffectGroup> groups;
  std::vector<std::string> grouped;
  for (const auto& known : known_groups()) {
    EffectGroup group{known.name, {}};
    for (const auto& effect : effects)
      if (contains(known.effects, effect)) group.effects.push_back(effect);
    if (group.effects.empty()) continue;
    grouped.insert(grouped.end(), group.effects.begin(), group.effects.end());
    groups.push_back(std::move(group));
  }
  for (const auto& effect : effects)
    if (!contains(grouped, effect)) groups.push_back({effect, {effect}});
  return groups;
}

bool any_sums(const std::vector<EffectGroup>& groups) {
  return std::any_of(groups.begin(), groups.end(),
                     [](const EffectGroup& group) { return group.effects.size() > 1; });
}

}  // namespace pipelines
