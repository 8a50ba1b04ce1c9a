/// Suggestions for misspelt names.
#pragma once

#include <string>
#include <vector>

namespace pipelines {

/// The known name that takes the fewest edits (insert, delete, replace, swap neighbours) from `name`, letters
/// compared without case; empty if none is near: more than a third of its length, at least two edits, away.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// "a, b, c"
std::string listed(const std::vector<std::string>& names);

}  // namespace pipelines
