#include "pipelines/scene/reader/scene_effects.h"

#include <algorithm>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/whole/body_reader.h"

namespace pipelines {

std::vector<std::string> names_of(const std::vector<kinetics::EffectInfo>& table) {
  std::vector<std::string> names;
  for (const auto& effect : table)
    if (!contains(names, effect.name)) names.push_back(effect.name);
  return names;
}

namespace {

const EffectRefusal* find_refusal(const EffectRules& rules, const std::string& effect) {
  const auto refusal = std::find_if(rules.refused.begin(), rules.refused.end(),
                                    [&](const auto& r) { return r.effect == effect; });
  return refusal == rules.refused.end() ? nullptr : &*refusal;
}

std::string remedy_for_unknown(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "unknown effect; known are: " + listed(known)
                         : "unknown effect; did you mean \"" + nearest + "\"?";
}

/// Every effect that the scene has data for.
std::vector<std::string> offered_effects(const EffectRules& rules) {
  const auto known = names_of(rules.table);
  std::vector<std::string> off = rules.lacking;
  for (const auto& refusal : rules.refused) off.push_back(refusal.effect);
  return names_without(known, with_dependents(rules.table, known, off));
}

/// Reads `effects` where it is a word: "all" or "auto".
void read_word(SceneTable& root, const EffectRules& rules, Scene& scene) {
  const std::string word = root.text("effects");
  if (word != "all" && word != "auto") {
    const std::string nearest = nearest_name(word, {"all", "auto"});
    if (!word.empty())
      root.refuse("effects", "is no list of effects; write names such as [\"" + rules.table.front().name +
                                 "\"], or \"all\", or \"auto\" for those that matter" +
                                 (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
    return;
  }
  scene.effects = scene.effects_key.offered;
  if (word == "all") return;
  scene.effect_choice.offered = scene.effects;
  scene.effect_choice.open = true;
}

}  // namespace

bool has_effect(const std::vector<kinetics::EffectInfo>& table, const std::string& name) {
  return std::any_of(table.begin(), table.end(), [&](const auto& effect) { return effect.name == name; });
}

void add_own_effects(EffectRules& rules, const std::string& machine_type, const SceneTable& root) {
  for (const auto* kind : body_readers()) {
    if (kind->machine_type() != machine_type) continue;
    const std::string table = kind->tables().front();
    const bool has_body = root.has(table), begins_with_vowel = table.find_first_of("aeiou") == 0;
    for (const auto& effect : kind->own_effects()) {
      if (!has_effect(rules.table, effect.name)) rules.table.push_back(effect);
      if (!has_body)
        rules.refused.push_back(
            {effect.name, std::string("needs ") + (begins_with_vowel ? "an [" : "a [") + table +
                              "], whose mesh gives its mass; add the table or remove the effect"});
    }
  }
}

void read_effects(SceneTable& root, const EffectRules& rules, Scene& scene, SceneFindings& findings) {
  const TextAt key = root.written_at("effects");
  scene.effects_key = {key.at.line, key.at.column, key.as_written, offered_effects(rules)};
  if (root.has("effects") && !root.has_list("effects")) return read_word(root, rules, scene);
  const auto known = names_of(rules.table);

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
    const EffectRefusal* const refusal = find_refusal(rules, effect.text);
    const bool is_known = contains(known, effect.text);
    if (refusal != nullptr)
      refuse(effect, refusal->remedy);
    else if (!is_known)
      refuse(effect, remedy_for_unknown(effect.text, known));
    else if (contains(names, effect.text))
      refuse(effect, "is named twice; remove one of the two");
    if (is_known && !contains(names, effect.text)) names.push_back(effect.text);
  }
  for (const auto& open : open_needs(rules.table, names))
    for (const TextAt& effect : listed_effects)
      if (effect.text == open.effect)
        refuse(effect, "needs the effect \"" + open.need.effect + "\": " + open.need.reason +
                           "; add that one or remove this one");
  scene.effects = names;
}

}  // namespace pipelines
