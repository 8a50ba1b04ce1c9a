/// The table of the vibratory mill's effects: name -> maker, description, source, what it needs.
#pragma once

#include <string>
#include <vector>

#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {

using Maker = Effect (*)(const VibratoryMill&);

struct EffectRow {
  EffectInfo info;
  Maker consistent;  ///< null: not part of that convention
  Maker published;
};

/// All effects, in the order of summation.
const std::vector<EffectRow>& effect_table();

/// Names of a convention's effects, in the order of summation.
std::vector<std::string> effect_names(Convention convention);

}  // namespace kinetics::vibratory
