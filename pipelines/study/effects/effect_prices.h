/// What each effect is worth in the peak stress, and what it costs: for deciding which ones a scene calls
/// for.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/base/fields/field.h"
#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

struct EffectPrice {
  std::string effect;
  /// Share of the peak von Mises stress (superposition.h); negative: it relieves the place.
  double share = 0;
  std::size_t n_channels = 0;  ///< channels that it feeds
  std::size_t n_own = 0;  ///< channels that it alone feeds: without it they are neither solved nor superposed
  double evaluation_s = 0;  ///< seconds of the load stage
  /// Seconds of the solve, at most: the factorisation is counted as if it grew with channels.
  double unit_loads_s = 0;
  double superposition_s = 0;  ///< seconds of the superposition, at most
};

/// Prices the effects of a body's own channels. Seconds of solve and superposition are shared out evenly over
/// the channels, the factorisation apart, which every effect needs.
/// @param solve_s, superpose_s  of this run; 0: not known
/// @param evaluation_s          seconds of the load stage with and without the effect, by effect; may be
/// shorter
std::vector<EffectPrice> price_effects(const Judged& analysis, double solve_s, double superpose_s,
                                       const std::vector<std::pair<std::string, double>>& evaluation_s);

/// Fields of the terminal alone: seconds change from run to run.
FieldTable<EffectPrice> effect_price_fields();

/// One line for each effect: share of the peak, channels, seconds.
void print_effect_prices(std::ostream& out, const std::string& body, const std::vector<EffectPrice>& prices);

}  // namespace pipelines
