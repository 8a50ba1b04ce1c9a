/// Parts that the short table on the terminal and the full one share. Internal to the report.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>

#include "pipelines/judge/texts/run_report.h"

namespace pipelines {

/// The title with the verdict, what was set and read, and the verdict's lines.
void print_title_and_verdict(std::ostream& out, const RunReport& report);

/// Largest, least and mean loads over the window; the rest is in summary.json.
void print_loads(std::ostream& out, const RunReport& report);

/// Load tables whose samples are not at the instants, and what lies between.
void print_resampling(std::ostream& out, const RunReport& report);

void print_bearings(std::ostream& out, const RunReport& report);

/// "turn 4, 30 deg"
std::string moment_text(const RunReport& report, std::int32_t instant);

/// "(1.0, 2.0, 3.0) mm"
std::string point_text(const std::array<double, 3>& position_m);

}  // namespace pipelines
