/// The fields of operating blocks, each declared once.
#pragma once

#include <string>

#include "pipelines/base/fields/field.h"
#include "pipelines/judge/life/duty_result.h"

namespace pipelines {

/// A place of a body over all blocks.
struct DutyPlaceRow {
  const DutyResult& duty;
  const std::string& body;
  const DutyPlace& place;
};

/// Places over all blocks: duty.csv, duty.places.<body>.
FieldTable<DutyPlaceRow> duty_place_fields();

/// Blocks: duty.blocks.<block>.
FieldTable<BlockResult> block_fields();

/// Largest stress of a body in a block: duty.blocks.<block>.bodies.<body>.
FieldTable<BlockStress> block_stress_fields();

/// Bearings over all blocks: duty.bearings.<bearing>.
FieldTable<DutyBearing> duty_bearing_fields();

}  // namespace pipelines
