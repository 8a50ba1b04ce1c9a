/// A scene as a tree of TOML values, before it is checked: for many versions of one file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipelines/base/files/toml_tree.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// @throws SceneError if there is no such file, or it is no TOML
TomlNode read_scene_tree(const std::filesystem::path& file);

/// The tree without its operating blocks, where nothing follows from them.
TomlNode without_duty(TomlNode tree);

/// What the reading of one more version of a scene can do without. What is refused, and how, is the same.
struct VersionReading {
  /// Whether a body has the shape of one that was accepted before, so that the mesher need not be asked
  /// again; empty: every shape is checked.
  std::function<bool(const BodyScene& body)> has_accepted_shape{};
  bool has_notes = true;  ///< Scene::defaults and Scene::known_keys are filled
  /// The caller runs the load stage at once and, if that or a bearing's load is refused, reads again without
  /// this: the reader does not compute loads of its own.
  bool loads_follow = false;
  /// Whether an operating block that leaves the sampling to the scene takes as many instants as its own
  /// orders ask for.
  bool takes_instants_of_orders = false;
};

/// The scene of a file whose tree is read, as read_scene of the file gives it.
/// @param tree  from read_scene_tree; a copy takes the settings
/// @throws as read_scene
Scene read_scene(const std::filesystem::path& file, TomlNode tree, const std::vector<std::string>& settings,
                 const VersionReading& version = {});

}  // namespace pipelines
