/// What the present mesh of a search is worth. Internal to the search.
#pragma once

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/search/loop/search_state.h"

namespace pipelines {

bool is_met(const Search& search, const GoverningStress& stress);

/// Enters what the meshes so far, and all cells of the present one, tell of the places into the analysis, and
/// into the state what a next step would cut. Where the changes of the stress alone would meet the tolerance,
/// all places are asked at once: the search may end.
/// @param meshed  the present mesh, whose places the state's history has
void judge_places(const MeshedBody& meshed, SearchState& state, BodyAnalysis& analysis, StageClock& clock);

/// Before a search ends: places that no step was for have errors of their own. Nothing where they have been
/// asked on the present mesh.
void judge_other_places(const MeshedBody& meshed, SearchState& state, BodyAnalysis& analysis,
                        StageClock& clock);

}  // namespace pipelines
