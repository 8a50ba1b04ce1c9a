/// Parts of summary.json. Internal to the summary.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "pipelines/report_parts/json_values.h"
#include "pipelines/report_parts/run_report.h"

namespace pipelines::summary {

/// "feature", "place", "position_m", "turn", "drive_angle_rad".
Json place_and_moment(const RunReport& report, const std::array<double, 3>& position,
                      const std::string& feature, Place place, std::int32_t instant);

/// bodies.<body>.zones, with the causes of the first zones, and the parts.
Json zones_json(const RunReport& report, const BodyAnalysis& analysis);

/// What bodies.<body> has.
Json body_json(const RunReport& report, const BodyAnalysis& analysis);

}  // namespace pipelines::summary
