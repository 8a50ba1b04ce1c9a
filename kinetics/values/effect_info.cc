#include "kinetics/values/effect_info.h"

#include <algorithm>

#include "kinetics/values/machine_refused.h"

namespace kinetics {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool needs_one_of(const EffectInfo& info, const std::vector<std::string>& effects) {
  return std::any_of(info.needs.begin(), info.needs.end(),
                     [&](const EffectNeed& need) { return contains(effects, need.effect); });
}

}  // namespace

std::vector<OpenNeed> open_needs(const std::vector<EffectInfo>& table,
                                 const std::vector<std::string>& effects) {
  std::vector<OpenNeed> open;
  for (const EffectInfo& info : table) {
    if (!contains(effects, info.name)) continue;
    for (const EffectNeed& need : info.needs)
      if (!contains(effects, need.effect)) open.push_back({info.name, need});
  }
  return open;
}

std::vector<std::string> with_dependents(const std::vector<EffectInfo>& table,
                                         const std::vector<std::string>& on,
                                         const std::vector<std::string>& effects) {
  std::vector<std::string> together = effects;
  for (std::size_t before = 0; before != together.size();) {
    before = together.size();
    for (const EffectInfo& info : table)
      if (contains(on, info.name) && !contains(together, info.name) && needs_one_of(info, together))
        together.push_back(info.name);
  }
  std::vector<std::string> ordered;
  std::copy_if(on.begin(), on.end(), std::back_inserter(ordered),
               [&](const std::string& name) { return contains(together, name); });
  return ordered;
}

void require_needs(const std::vector<EffectInfo>& table, const std::vector<std::string>& effects) {
  const auto open = open_needs(table, effects);
  if (open.empty()) return;
  const auto& [effect, need] = open.front();
  throw MachineRefused("effect " + effect + ": needs the effect " + need.effect + ": " + need.reason +
                       "; add that one, or take " + effect + " out");
}

}  // namespace kinetics
