/// The fields of rolling bearings under the loads of a cycle, each declared once.
#pragma once

#include <vector>

#include "pipelines/base/fields/field.h"
#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/loads/channels/bearings.h"

namespace pipelines {

/// Loads and L10: bearings.<bearing>.
FieldTable<BearingResult> bearing_fields();

/// What the scene asks beyond L10, there too.
FieldTable<BearingResult> bearing_answer_fields();

/// The object `bearings`; null without any.
summary::Json bearings_json(const std::vector<BearingResult>& bearings);

/// Loads and L10 for people.
/// @param bearings  bearings of summary.json
ShownRows shown_bearings(const summary::Json& bearings);

/// Answers for people; nothing where the scene asks nothing.
ShownRows shown_bearing_answers(const summary::Json& bearings);

}  // namespace pipelines
