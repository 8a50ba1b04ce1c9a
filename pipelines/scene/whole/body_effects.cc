#include "pipelines/scene/whole/body_effects.h"

#include <utility>

#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

using kinetics::EffectInfo;

std::vector<EffectInfo> body_effect_table(const BodyScene& body) {
  return reader_of(body).effects(body);
}

std::vector<EffectInfo> effect_table(const Scene& scene) {
  std::vector<EffectInfo> table = effects_of(scene.machine);
  for (const auto& body : scene.bodies) {
    reader_of(body).add_needs(scene, table);
    for (auto& info : body_effect_table(body)) table.push_back(std::move(info));
  }
  return table;
}

}  // namespace pipelines
