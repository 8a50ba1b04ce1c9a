/// Histories of stress as files for fatigue tools and spreadsheets, and as the terminal shows them.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/write/files/stress_histories.h"

namespace pipelines {

/// histories.h5, then a table for each point.
std::vector<std::string> stress_history_files(const StressHistories& histories);

/// histories.h5 has /time [s], /drive_angle [deg], and for each point the group /<body>/<point> with stress
/// (instants x 6), von_mises, signed_von_mises and principal (instants x 3, falling) [MPa], each with its
/// unit as attribute; <point> is its name with _ for what a file's name may not have, "zone_1".
/// <body>_<point>.csv has the same.
/// @throws FileError naming the file if it cannot be written
void write_stress_histories(const std::filesystem::path& directory, const StressHistories& histories);

/// @param json  as JSON instead of a table
void print_stress_histories(std::ostream& out, const StressHistories& histories, bool json);

}  // namespace pipelines
