#include "pipelines/scene.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pipelines {
namespace {

std::string all_texts(const std::vector<SceneError>& errors) {
  std::string text;
  for (const SceneError& error : errors) text += (text.empty() ? "" : "\n") + error.text();
  return text;
}

bool needs_the_body(const std::string& effect) {
  return effect == "gravity_shaft" || effect == "shaft_inertia";
}

}  // namespace

std::string SceneError::text() const {
  std::string text = file + ":";
  if (line > 0) text += std::to_string(line) + ":" + std::to_string(column) + ":";
  if (!key.empty()) text += " " + key + (value.empty() ? "" : " = " + value) + ":";
  return text + " " + remedy;
}

SceneErrors::SceneErrors(std::vector<SceneError> errors)
    : std::runtime_error(all_texts(errors)), errors_(std::move(errors)) {}

std::vector<std::string> Scene::kinetics_effects() const {
  std::vector<std::string> names;
  std::remove_copy_if(effects.begin(), effects.end(), std::back_inserter(names), needs_the_body);
  return names;
}

bool Scene::has_effect(const std::string& name) const {
  return std::find(effects.begin(), effects.end(), name) != effects.end();
}

}  // namespace pipelines
