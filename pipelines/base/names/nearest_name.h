/// Suggestions for misspelt names.
#pragma once

#include <string>
#include <vector>

#include "kinetics/values/wrong_input.h"

namespace pipelines {

/// The known name that takes the fewest edits (insert, delete, replace, swap neighbours) from `name`, letters
/// compared without case; empty if none is near: more than a third of its length, at least two edits, away.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

using kinetics::listed;  // "a, b, c"

}  // namespace pipelines
