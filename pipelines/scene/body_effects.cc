#include "pipelines/scene/body_effects.h"

#include <algorithm>

#include "pipelines/scene/body_kind.h"
#include "pipelines/scene/scene.h"

namespace pipelines {

using kinetics::EffectInfo;

std::vector<EffectInfo> body_effect_table(const BodyScene& body) {
  const BodyKind& kind = kind_of(body);
  std::vector<EffectInfo> table = kind.own_effects(), forces;
  for (const auto& force : kind.given_forces(body))
    if (std::none_of(forces.begin(), forces.end(),
                     [&](const auto& info) { return info.name == force.effect; }))
      forces.push_back({force.effect, "Force on the shaft beside the train's torques.", "the user's"});
  table.insert(table.end(), forces.begin(), forces.end());
  return table;
}

std::vector<EffectInfo> effect_table(const Machine& machine, const std::vector<BodyScene>& bodies) {
  std::vector<EffectInfo> table = effects_of(machine);
  for (const auto& body : bodies) {
    kind_of(body).add_needs(machine, table);
    for (auto& info : body_effect_table(body)) table.push_back(std::move(info));
  }
  return table;
}

std::vector<EffectInfo> effect_table(const Scene& scene) {
  return effect_table(scene.machine, scene.bodies);
}

}  // namespace pipelines
