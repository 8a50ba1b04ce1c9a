/// The charts and maps of `millstress sweep`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/variations/sweep_points.h"

namespace pipelines {

/// A chart for each key and unit; of a grid of two keys a map of each of the first two figures.
/// @return the files that were written
std::vector<std::string> draw_charts(const std::filesystem::path& directory, const std::string& title,
                                     const SweepPlan& plan, const std::vector<SweepRow>& rows,
                                     const std::vector<std::string>& figures, SweepDesign design);

}  // namespace pipelines
