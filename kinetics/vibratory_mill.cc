#include "kinetics/vibratory_mill.h"

#include <cmath>

#include "kinetics/values/wrong_input.h"
#include "kinetics/vibratory/balance.h"
#include "kinetics/vibratory/checks.h"
#include "kinetics/vibratory/published.h"

namespace kinetics {

LoadHistory compute_loads(const VibratoryMill& mill, const std::vector<std::string>& effects,
                          const TimeGrid& grid) {
  vibratory::check_effects(mill.convention, effects);
  vibratory::check_parameters(mill, effects);
  check_grid(grid);
  const auto made = vibratory::make_effects(mill, effects);
  LoadHistory history = mill.convention == Convention::published
                            ? vibratory::published_loads(mill, made, grid)
                            : vibratory::balance(mill, made, grid);
  const auto period = period_in_turns(mill);
  if (!period || grid.turns % *period != 0)
    history.warnings.push_back("the history covers " + number(grid.turns) + " turns, the motion repeats " +
                               (period ? "after " + number(*period) + " turns"
                                       : std::string("never: drive and charge are incommensurate")) +
                               "; extremes and means are those of the window");
  return history;
}

std::optional<int> period_in_turns(const VibratoryMill& mill, int most_turns) {
  if (mill.charge_offset_m == 0) return 1;
  const double ratio = vibratory::charge_speed_ratio(mill);
  for (int q = 1; q <= most_turns; ++q)
    if (std::abs(ratio - std::round(ratio * q) / q) <= 1e-9) return q;
  return std::nullopt;
}

}  // namespace kinetics
