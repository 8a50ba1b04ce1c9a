/// A comparison for people and for machines.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/study/comparison/comparison.h"

namespace pipelines {

/// Verdicts, keys that differ, figures, places, the loads that differ most, cost.
/// @param all  every figure, not only those that lead
void print_comparison(std::ostream& out, const Comparison& comparison, bool all);

/// `runs`, `keys`, `figures` with `values` (value, least, most; null where a run has none) and `from_first`
/// (absolute, relative, least, most, is_told, text), in SI.
std::string comparison_json(const Comparison& comparison);

/// comparison.json, comparison.csv and comparison.html with the bodies' pictures on one scale.
/// @return names of all that was written
std::vector<std::string> write_comparison(const std::filesystem::path& folder, const Comparison& comparison);

}  // namespace pipelines
