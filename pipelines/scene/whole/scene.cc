#include "pipelines/scene/whole/scene.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "pipelines/scene/whole/body_effects.h"

namespace pipelines {

std::string mesh_key(const std::string& control) {
  const std::string unit = "_m";
  const bool has_unit = control.size() > unit.size() && control.substr(control.size() - 2) == unit;
  return has_unit ? control.substr(0, control.size() - unit.size()) : control;
}

PressureModel usual_pressure(const BodyScene& body, const std::string& port) {
  PressureModel usual;
  usual.highest_harmonic = body.pressure_harmonics;
  usual.is_charge = port == "inner_wall" && (std::holds_alternative<ChamberOptions>(body.options) ||
                                             std::holds_alternative<DrumOptions>(body.options));
  if (usual.is_charge) usual.half_angles = half_angles_around(usual.pattern);
  return usual;
}

BodyScene::BodyScene() = default;
BodyScene::BodyScene(const BodyScene&) = default;
BodyScene::BodyScene(BodyScene&&) noexcept = default;
BodyScene& BodyScene::operator=(const BodyScene&) = default;
BodyScene& BodyScene::operator=(BodyScene&&) noexcept = default;
BodyScene::~BodyScene() = default;

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

std::vector<std::string> Scene::kinetics_effects() const {
  std::vector<std::string> of_bodies;
  for (const auto& body : bodies) {
    for (const auto& effect : body_effect_table(body)) of_bodies.push_back(effect.name);
  }
  std::vector<std::string> names;
  std::remove_copy_if(effects.begin(), effects.end(), std::back_inserter(names), [&](const auto& effect) {
    return std::find(of_bodies.begin(), of_bodies.end(), effect) != of_bodies.end();
  });
  return names;
}

const BodyScene* Scene::body(const std::string& name) const {
  const auto found =
      std::find_if(bodies.begin(), bodies.end(), [&](const auto& b) { return b.name == name; });
  return found == bodies.end() ? nullptr : &*found;
}

bool Scene::has_effect(const std::string& name) const {
  return std::find(effects.begin(), effects.end(), name) != effects.end();
}

}  // namespace pipelines
