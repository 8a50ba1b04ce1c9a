#include "pipelines/scene_effects.h"

#include <algorithm>

#include "pipelines/nearest.h"

namespace pipelines {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// An effect that makes no sense without another one.
struct Need {
  const char* effect;
  const char* needed;
  const char* reason;
};

constexpr Need needs[] = {
    {"charge_follows_pitch", "pitch", "the charge can follow the pitch only of a chamber that pitches"},
    {"charge_lag", "charge_translation", "the lag delays the force of charge_translation"},
    {"pitch", "springs", "nothing but the springs holds the attitude of a chamber that pitches"},
};

/// What to write instead of an unknown effect.
std::string remedy_for_unknown(const std::string& name, kinetics::Convention convention) {
  using kinetics::Convention;
  const bool is_published = convention == Convention::published;
  const Convention other = is_published ? Convention::consistent : Convention::published;
  const std::string here = is_published ? "published" : "consistent";
  if (contains(known_effects(other), name))
    return "unknown under convention \"" + here + "\", only under the other one; remove it, or change " +
           "machine.convention";
  const std::vector<std::string> known = known_effects(convention);
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "unknown effect; known are: " + listed(known)
                         : "unknown effect; did you mean \"" + nearest + "\"?";
}

}  // namespace

std::vector<std::string> known_effects(kinetics::Convention convention) {
  std::vector<std::string> names;
  for (const auto& effect : kinetics::vibratory_mill_effects(convention)) names.push_back(effect.name);
  for (const char* from_the_mesh : {"gravity_shaft", "shaft_inertia"})
    if (!contains(names, from_the_mesh)) names.push_back(from_the_mesh);
  return names;
}

std::vector<std::string> read_effects(SceneTable& root, kinetics::Convention convention, bool has_shaft,
                                      SceneFindings& findings) {
  const std::vector<std::string> known = known_effects(convention);
  const std::vector<TextAt> listed_effects = root.texts("effects");
  if (root.has("effects") && listed_effects.empty())
    root.refuse("effects",
                "no effect is named, so there is nothing to compute; name some of: " + listed(known));

  const auto refuse = [&](const TextAt& effect, const std::string& remedy) {
    findings.errors.push_back(
        {findings.file, effect.at.line, effect.at.column, effect.key, effect.as_written, remedy});
  };
  std::vector<std::string> names;
  for (const TextAt& effect : listed_effects) {
    if (!contains(known, effect.text))
      refuse(effect, remedy_for_unknown(effect.text, convention));
    else if (contains(names, effect.text))
      refuse(effect, "is named twice; remove one of the two");
    else
      names.push_back(effect.text);
  }
  for (const TextAt& effect : listed_effects) {
    for (const Need& need : needs)
      if (effect.text == need.effect && !contains(names, need.needed))
        refuse(effect, "needs the effect \"" + std::string(need.needed) + "\": " + need.reason +
                           "; add that one or remove this one");
    const bool is_of_the_shaft = effect.text == "gravity_shaft" || effect.text == "shaft_inertia";
    if (is_of_the_shaft && !has_shaft)
      refuse(effect, "needs a [shaft], whose mesh gives its mass; add the table or remove the effect");
  }
  return names;
}

}  // namespace pipelines
