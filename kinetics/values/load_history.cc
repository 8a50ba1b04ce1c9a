#include "kinetics/values/load_history.h"

#include <algorithm>
#include <stdexcept>

#include "kinetics/values/wrong_input.h"

namespace kinetics {

void check_grid(const TimeGrid& grid) {
  if (grid.turns < 1) refuse("turns", grid.turns, "must be at least 1");
  if (grid.instants_per_turn < 4)
    refuse("instants_per_turn", grid.instants_per_turn,
           "must be at least 4; the loads carry the first and second harmonic");
}

const Quantity& LoadHistory::quantity(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& candidate : quantities) {
    if (candidate.name == name) return candidate;
    names.push_back(candidate.name);
  }
  throw std::out_of_range("the load history of " + machine + " (" + convention + ") has no quantity \"" +
                          name + "\"; it has: " + listed(names));
}

bool LoadHistory::has_resultant(const std::string& role) const {
  return std::any_of(resultants.begin(), resultants.end(), [&](const auto& r) { return r.role == role; });
}

const Resultant& LoadHistory::resultant(const std::string& role) const {
  std::vector<std::string> roles;
  for (const auto& candidate : resultants) {
    if (candidate.role == role) return candidate;
    roles.push_back(candidate.role);
  }
  throw std::out_of_range("the load history of " + machine + " (" + convention +
                          ") has no resultant of role \"" + role + "\"; it has: " + listed(roles));
}

}  // namespace kinetics
