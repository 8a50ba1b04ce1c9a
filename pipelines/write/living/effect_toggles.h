/// What a body's loads are without an effect, or a group of them, by the load stage itself: with everything
/// that follows, as springs that carry less and guides that hold less.
#pragma once

#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/write/living/factor_signals.h"

namespace pipelines {

struct EffectToggle {
  std::string name;                      ///< the effect, or the group
  std::vector<std::string> effects;      ///< what it switches
  std::vector<std::string> off;          ///< all that is off then, `effects` too; empty: it cannot be off
  std::string why;                       ///< why more is off, or why nothing can be
  std::vector<Eigen::ArrayXXd> without;  ///< signals by body; empty if it cannot be off
};

/// Every effect that is on, then every group of several. Where a run refuses an effect off alone, what has to
/// go with it goes too; effects without which there is no run stay, with the reason.
/// @param analyses  in the order of the scene's bodies
/// @param signals   of their loads
std::vector<EffectToggle> effect_toggles(const Loaded& loaded, const std::vector<Judged>& analyses,
                                         const std::vector<FactorSignals>& signals, int n_threads);

}  // namespace pipelines
