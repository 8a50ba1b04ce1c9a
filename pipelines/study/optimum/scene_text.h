/// A scene as TOML text, with keys that were set.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/base/files/toml_tree.h"

namespace pipelines {

/// The TOML text of a tree, which reads as the same tree. Comments of its file are not in it.
std::string toml_text(const TomlNode& root);

/// The tree with the names of files that lie beside the scene as they are seen from another directory.
/// @param scene  file of the scene
TomlNode with_files_seen_from(const std::filesystem::path& directory, TomlNode root,
                              const std::filesystem::path& scene);

}  // namespace pipelines
