/// What a run adds to a body whose stresses it knows. Internal to run_scene.
#pragma once

#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// Natural frequencies and critical speeds, where the body asks for them.
/// @param seconds  that they may take; infinite: no limit
/// @return warnings; one of them says so if they are left out
std::vector<std::string> add_frequencies(const Scene& scene, const MeshedBody& meshed,
                                         const kinetics::LoadHistory& loads, double seconds, Judged& analysis,
                                         StageClock& clock);

/// Fatigue of the final stresses.
/// @param seconds  as above
/// @return warnings, as above
std::vector<std::string> add_fatigue(const Scene& scene, const kinetics::LoadHistory& loads, double seconds,
                                     int n_threads, Judged& analysis, StageClock& clock);

}  // namespace pipelines
