#include "kinetics/planetary/table.h"

#include <algorithm>

namespace kinetics::planetary {
namespace {

std::vector<EffectInfo> infos(PlanetaryConvention convention) {
  std::vector<EffectInfo> list;
  for (const EffectRow& row : effect_table()) {
    list.push_back(row.info);
    list.back().name = row.name(convention);
  }
  return list;
}

}  // namespace

const std::string& EffectRow::name(PlanetaryConvention convention) const {
  const bool renamed = convention == PlanetaryConvention::consistent && !consistent_name.empty();
  return renamed ? consistent_name : info.name;
}

const std::vector<EffectRow>& effect_table() {
  static const std::vector<EffectRow> table = {
      {{"drum_transport", "Centrifugal force of the drum that the carrier takes round.", "(9)"},
       "",
       drum_transport},
      {{"charge_transport",
        "Centrifugal force of the charge as if its centroid lay on the drum's axis, with its moment.",
        "(10)"},
       "",
       charge_transport},
      {{"charge_relative",
        "Centrifugal force of the charge for its centroid's distance from the drum's axis.",
        "(11); with the carrier's speed under consistent"},
       "charge_offset",
       charge_offset},
      {{"drum_gravity", "Weight of the drum.", "(14)"}, "", drum_gravity},
      {{"charge_gravity", "Weight of the charge, with its moment about the drum's axis.", "(14)"},
       "",
       charge_gravity},
      {{"belt", "Pull of both strands on the drum's pulley; balances the charge's moment.", "(14), (15)"},
       "",
       belt},
  };
  return table;
}

std::vector<std::string> effect_names(PlanetaryConvention convention) {
  std::vector<std::string> names;
  for (const EffectRow& row : effect_table()) names.push_back(row.name(convention));
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<NamedEffect> make_effects(const Machine& machine, const std::vector<std::string>& names) {
  std::vector<NamedEffect> effects;
  for (const EffectRow& row : effect_table())
    if (const auto& name = row.name(machine.mill.convention); contains(names, name))
      effects.push_back({name, row.make(machine)});
  return effects;
}

}  // namespace kinetics::planetary

namespace kinetics {

const std::vector<EffectInfo>& planetary_mill_effects(PlanetaryConvention convention) {
  static const std::vector<EffectInfo> consistent = planetary::infos(PlanetaryConvention::consistent);
  static const std::vector<EffectInfo> paper = planetary::infos(PlanetaryConvention::as_published);
  return convention == PlanetaryConvention::consistent ? consistent : paper;
}

}  // namespace kinetics
