#include "pipelines/write/living/effect_toggles.h"

#include <exception>
#include <utility>

#include "kinetics/values/effect_info.h"
#include "pipelines/base/common/parallel.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/loads/stage/effect_closure.h"
#include "pipelines/scene/values/effect_groups.h"
#include "pipelines/scene/whole/body_effects.h"

namespace pipelines {
namespace {

using Names = std::vector<std::string>;

/// Why others go with the effects.
std::string why_together(const Scene& scene, const Names& effects, const Names& off) {
  std::string text;
  const auto open = kinetics::open_needs(effect_table(scene), names_without(scene.effects, effects));
  for (const auto& other : names_without(off, effects)) {
    std::string reason = "the loads on a body would not balance";
    for (const auto& need : open)
      if (need.effect == other) reason = "it needs " + need.need.effect + ": " + need.need.reason;
    text += (text.empty() ? "" : "; ") + other + " goes with it, " + reason;
  }
  return text;
}

/// Why a run without them is refused.
std::string why_not(Scene scene, const Loaded& loaded, const Names& effects) {
  const auto open = kinetics::open_needs(effect_table(scene), names_without(scene.effects, effects));
  if (!open.empty())
    return open.front().effect + " needs " + open.front().need.effect + ": " + open.front().need.reason;
  scene.effects = names_without(scene.effects, effects);
  if (scene.kinetics_effects().empty()) return "nothing would be left to compute";
  try {
    try_effects(scene, loaded.meshed, loaded.masses);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "the loads on a body would not balance, or nothing would load it";
}

void find_loads_without(const Loaded& loaded, const std::vector<Judged>& analyses,
                        const std::vector<FactorSignals>& signals, EffectToggle& toggle) {
  const auto found = closed_set(loaded.scene, loaded.meshed, loaded.masses, toggle.effects);
  if (!found) {
    toggle.why = why_not(loaded.scene, loaded, toggle.effects);
    return;
  }
  std::string trouble;
  for (std::size_t i = 0; i < signals.size(); ++i)
    toggle.without.push_back(signals_of(signals[i], analyses[i].loads, found->trial.bodies[i], trouble));
  if (!trouble.empty()) {
    toggle.without.clear();
    toggle.why = trouble;
    return;
  }
  toggle.off = found->off;
  toggle.why = why_together(loaded.scene, toggle.effects, toggle.off);
}

}  // namespace

std::vector<EffectToggle> effect_toggles(const Loaded& loaded, const std::vector<Judged>& analyses,
                                         const std::vector<FactorSignals>& signals, int n_threads) {
  std::vector<EffectToggle> toggles;
  for (const auto& effect : loaded.scene.effects) toggles.push_back({effect, {effect}, {}, "", {}});
  for (const auto& group : effect_groups(loaded.scene.effects))
    if (group.effects.size() > 1) toggles.push_back({group.name, group.effects, {}, "", {}});
  for_each_parallel(toggles.size(), n_threads, [&](std::size_t, std::size_t i) {
    find_loads_without(loaded, analyses, signals, toggles[i]);
  });
  return toggles;
}

}  // namespace pipelines
