/// Operating blocks in the terminal, in summary.json, and as duty.csv.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/judge/life/duty_result.h"

namespace pipelines {

/// Blocks with their stresses, the first places with their lives, bearings.
void print_duty(std::ostream& out, const DutyResult& duty);

/// What `duty` has.
summary::Json duty_json(const DutyResult& duty);

/// What people read of `duty.blocks`: a row of each block and body.
ShownRows shown_blocks(const summary::Json& blocks);

/// What people read of `duty.places.<body>`: the first ones.
ShownRows shown_duty_places(const summary::Json& places, std::size_t most);

/// What people read of `duty.bearings`.
ShownRows shown_duty_bearings(const summary::Json& bearings);

/// A row for every place of every body: damage per hour in operation, in all, and by each block's running and
/// starts.
void write_duty(const std::filesystem::path& file, const DutyResult& duty);

}  // namespace pipelines
