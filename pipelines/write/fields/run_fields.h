/// The fields of how a run came to its results, each declared once.
#pragma once

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/base/fields/field.h"
#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/judge/estimates/search_record.h"
#include "pipelines/judge/figures/critical_speeds.h"
#include "pipelines/judge/figures/vibration.h"

namespace pipelines {

/// bodies.<body>.search.steps. Seconds are no part of summary.json: they change from run to run.
FieldTable<SearchStep> search_step_fields();

/// bodies.<body>.natural_frequencies.
FieldTable<NaturalFrequency> natural_frequency_fields();

/// bodies.<body>.critical_speeds: modes, loads.
FieldTable<CriticalSpeed> critical_speed_fields();

/// timing.<stage>.
FieldTable<StageCost> stage_fields();

}  // namespace pipelines
