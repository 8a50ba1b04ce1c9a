/// A scene as a tree of TOML values, before it is checked: for many versions of one file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/files/toml_tree.h"
#include "pipelines/scene/scene.h"

namespace pipelines {

/// @throws SceneError if there is no such file, or it is no TOML
TomlNode read_scene_tree(const std::filesystem::path& file);

/// As read_scene of the file.
/// @param tree  of read_scene_tree; a copy takes the settings
/// @throws as read_scene
Scene read_scene(const std::filesystem::path& file, TomlNode tree, const std::vector<std::string>& settings);

}  // namespace pipelines
