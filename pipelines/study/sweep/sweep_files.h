/// What a sweep leaves: one table of all points.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/variations/sweep_points.h"

namespace pipelines {

/// A row per point: its number, from 1, the varied keys with their values, why it was refused, then every
/// figure that any point has ("nan" where this one has none) and every text.
/// @param n_threads  that format rows
void write_sweep_csv(const std::filesystem::path& file, const SweepPlan& plan,
                     const std::vector<SweepRow>& rows, int n_threads);

/// A row per point and zone: point and keys as above, then the zone's number as follow_zones gives it, where
/// and how large it is.
void write_sweep_zones(const std::filesystem::path& file, const SweepPlan& plan,
                       const std::vector<SweepRow>& rows, const std::vector<std::vector<int>>& numbers);

/// The table of points as datasets of one value per point: /keys/<key>, /figures/<figure> with the unit as
/// attribute, /texts/<name>, /refused. In names a dash stands for a slash.
void write_sweep_h5(const std::filesystem::path& file, const SweepPlan& plan,
                    const std::vector<SweepRow>& rows, const std::string& title);

std::string sweep_json(const SweepPlan& plan, const std::vector<SweepRow>& rows);

}  // namespace pipelines
