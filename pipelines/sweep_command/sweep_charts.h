/// The charts and maps of `millstress sweep`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/sweep/sweep_row.h"
#include "pipelines/variations/sweep_points.h"

namespace pipelines {

/// Files of this or an earlier sweep's charts and maps in a directory.
std::vector<std::string> charts_in(const std::filesystem::path& directory);

/// Those of an earlier sweep that this one has not drawn are of other points: they go.
void remove_other_charts(const std::filesystem::path& directory, const std::vector<std::string>& drawn);

/// A chart for each key and unit; of a grid of two keys a map of each of the first two figures.
/// @return the files that were written
std::vector<std::string> draw_charts(const std::filesystem::path& directory, const std::string& title,
                                     const SweepPlan& plan, const std::vector<SweepRow>& rows,
                                     const std::vector<std::string>& figures, SweepDesign design);

}  // namespace pipelines
