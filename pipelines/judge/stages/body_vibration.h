/// A body's natural frequencies beside its loads.
#pragma once

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// Natural frequencies and dynamic amplification, if the body asks for them; the latter also as an entry of
/// the budgets of the peak and of the largest hot-spot stress.
/// @param history  of the load stage, that the analysis' loads were distributed from
void add_vibration(const Scene& scene, const MeshedBody& meshed, const kinetics::LoadHistory& history,
                   Judged& analysis, StageClock& clock);

/// The entries of the budgets alone, of Judged::vibration; nothing without it.
void enter_vibration(Judged& analysis);

/// Critical speeds of a shaft, if it asks for them; after add_vibration, which their model is compared with.
void add_critical_speeds(const Scene& scene, const MeshedBody& meshed, const kinetics::LoadHistory& history,
                         Judged& analysis, StageClock& clock);

}  // namespace pipelines
