/// What a scene says about sweeps.
#pragma once

#include <filesystem>

#include "pipelines/base/files/toml_tree.h"
#include "pipelines/study/variations/sweep_points.h"

namespace pipelines {

/// [sweep] of a scene: vary, design, points, seed, zones, figures; an empty request where the scene has no
/// such table.
/// @param tree  tree of the scene (scene_tree.h)
/// @throws SceneError with every error found in the table
SweepRequest read_sweep_request(const std::filesystem::path& file, const TomlNode& tree);

/// @param text  as to_string has it
/// @throws OptionError if there is no such design
SweepDesign sweep_design(const std::string& text);

}  // namespace pipelines
