/// What a machine says about one of its effects.
#pragma once

#include <string>

namespace kinetics {

/// One named physical effect of a machine.
struct EffectInfo {
  std::string name;
  std::string description;  ///< one sentence
  std::string source;       ///< equation number, or "ours"
};

}  // namespace kinetics
