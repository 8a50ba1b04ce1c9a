/// Effects that one part of a machine brings together. The terms of one inertia may each be many times their
/// sum, since they cancel; nobody can change one of them alone. The group is what a designer can act on.
#pragma once

#include <string>
#include <vector>

namespace pipelines {

struct EffectGroup {
  std::string name;  ///< "weights", "inertia of the charge" ...; of a single effect: its own name
  std::vector<std::string> effects;  ///< in the order of the list
};

/// The groups that a list of effects falls into: weights, inertia of the charge, of the chamber, of the drum
/// and of the shaft, springs, debalances, belt, guides, as far as the list has effects of them; an effect
/// that belongs to none is a group by itself.
std::vector<EffectGroup> effect_groups(const std::vector<std::string>& effects);

/// Whether a group has more than one effect: else groups say nothing that effects do not.
bool any_sums(const std::vector<EffectGroup>& groups);

}  // namespace pipelines
