/// Parts of summary.json. Internal to the summary.
#pragma once

#include "pipelines/base/fields/json_values.h"
#include "pipelines/judge/texts/run_report.h"

namespace pipelines::summary {

/// What bodies.<body> has.
Json body_json(const RunReport& report, const Judged& analysis);

}  // namespace pipelines::summary
