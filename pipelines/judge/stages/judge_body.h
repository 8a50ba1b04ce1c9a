/// From the stress over the cycle to what is known of a body: peak, hot spots, diagrams, zones, and their
/// errors.
#pragma once

#include <vector>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// @param known            hot spots of these responses, whatever the loads, that were resolved before
/// @param needs_submodels  at weld toes; a search that refines the mesh there does without
/// @return all but zones
Judged judge_body(Superposed superposed, const MeshedBody& meshed, bool needs_submodels, int n_threads,
                  StageClock& clock, const std::vector<HotSpotStress>& known = {});

/// The same under other loads, or with other places left out, with the responses that the body has, what was
/// known of them, and all that is known of how they came about. The envelope stays where the loads are the
/// same, to the bit.
/// @param before           gives away what stays
/// @param needs_submodels  as of judge_body
Judged judge_again(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads, Judged& before,
                   bool needs_submodels, int n_threads, StageClock& clock);

/// Zones of the envelope with parts, causes and errors, and errors of weld toes that no search has judged:
/// what is shown of the final stress, and no search reads.
void add_zones(const ZoneRule& rule, Judged& analysis);

/// The stress from which on a node belongs to a zone [Pa].
double zone_level_Pa(const ZoneRule& rule, double peak_Pa, double yield_Pa);

/// An analysis under other loads on the same responses: loads, closure, envelope, peak, hot spots and what
/// they state of their own errors are new; diagrams and the error for load patches, which need the stress
/// everywhere, the causes of zones and their parts are left out.
/// @param loads    with the channels of the analysis, in their order
/// @param leading  what matters of the envelope: of each place that may lead the largest stress, zero or the
///                 stress at other nodes
/// @param zones    null: none; else the envelope is whole above their level
/// @throws LoadsDoNotClose as superpose; NotFinite
Judged under_other_loads(Judged analysis, const MeshedBody& meshed, BodyLoads loads, Envelope leading,
                         const ZoneRule* zones = nullptr);

}  // namespace pipelines
