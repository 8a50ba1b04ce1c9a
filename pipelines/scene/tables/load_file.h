/// Measured loads: one entry of [[machine.files]] with the file that it names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kinetics/table/load_table.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

/// Reads the entry, closes it, and appends its loads:
///   effect = "measured"  file = "log.csv" (pipelines/scene/tables/table_file.h) columns = { time = "Zeit",
///   "pulley.fx" = "Kraft X" }                  which title is which load delimiter = ";" decimal = ","
///   skip_rows = 3                           where the file does not tell by itself turns = "average" or "as
///   they are"                                    of a file of several turns
/// Without `columns` the first column is "time" or "angle", every other one "<port>.<component>".
/// Files with `turns` "as they are" raise loads.turns.
/// @param folder        folder of the scene: where files are looked for
/// @param window_turns  turns of the scene's sampling; 0: it leaves them to the machine
/// @return whether the loads are a mean turn, which repeats in a longer window
bool read_load_file(SceneTable& entry, const std::filesystem::path& folder, int window_turns,
                    SceneFindings& findings, kinetics::LoadTable& loads);

/// Repeats the mean turn of sampled loads over the window.
/// @param which  indices of the loads
void repeat_mean_turns(const std::vector<std::size_t>& which, int window_turns, kinetics::LoadTable& loads);

}  // namespace pipelines
