/// Operating blocks in the terminal, in summary.json, and as duty.csv.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "pipelines/life/duty_result.h"
#include "pipelines/report_parts/json_values.h"
#include "pipelines/report_parts/run_report.h"

namespace pipelines {

/// Blocks with their stresses, the first places with their lives, bearings.
void print_duty(std::ostream& out, const DutyResult& duty);

/// What `duty` has.
summary::Json duty_json(const DutyResult& duty);

/// A row for every place of every body: damage per hour in operation, in all, and by each block's running and
/// starts.
void write_duty(const std::filesystem::path& file, const DutyResult& duty);

}  // namespace pipelines
