/// What a machine says about one of its effects: the rows of its table, and which effects need which.
#pragma once

#include <string>
#include <vector>

namespace kinetics {

/// Another effect that an effect makes no sense without.
struct EffectNeed {
  std::string effect;  ///< the one that is needed
  std::string reason;  ///< a clause: "the lag delays the force of charge_translation"
  std::string source;  ///< equation number, section, or "ours"
};

/// One named physical effect of a machine or a body: a row of its table.
struct EffectInfo {
  std::string name;
  std::string description;  ///< one sentence
  std::string source;       ///< equation number, or "ours"
  std::vector<EffectNeed> needs{};
};

/// A need of an effect that is on, of one that is off.
struct OpenNeed {
  std::string effect;
  EffectNeed need;
};

/// The needs that a list of effects leaves open, in the order of the table.
std::vector<OpenNeed> open_needs(const std::vector<EffectInfo>& table,
                                 const std::vector<std::string>& effects);

/// The effects themselves and all of `on` that need one of them, directly or by way of others: what has to go
/// together. In the order of `on`.
std::vector<std::string> with_dependents(const std::vector<EffectInfo>& table,
                                         const std::vector<std::string>& on,
                                         const std::vector<std::string>& effects);

/// @throws MachineRefused naming the effect, what it needs and why, for the first need left open
void require_needs(const std::vector<EffectInfo>& table, const std::vector<std::string>& effects);

}  // namespace kinetics
