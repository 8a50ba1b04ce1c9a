/// The table of the planetary mill's effects: name -> maker, description, source, what it needs.
#pragma once

#include <string>
#include <vector>

#include "kinetics/planetary_effects/effect.h"

namespace kinetics::planetary {

struct EffectRow {
  EffectInfo info;
  std::string consistent_name;  ///< name under `consistent`, where it has another
  Effect (*make)(const Machine&);

  const std::string& name(PlanetaryConvention convention) const;
};

/// All effects, in the order of summation.
const std::vector<EffectRow>& effect_table();

/// Names of a convention's effects, in the order of summation.
std::vector<std::string> effect_names(PlanetaryConvention convention);

}  // namespace kinetics::planetary
