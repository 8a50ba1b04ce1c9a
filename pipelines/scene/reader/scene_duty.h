/// Reading [[duty]].
#pragma once

#include "pipelines/scene/reader/scene_tree.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

/// Reads the blocks, each a version of the scene with the keys of its table `set`.
/// @param root   root of `tree`
/// @param scene  read up to here, without errors; gets its blocks
void read_duty(SceneTable& root, const TomlNode& tree, Scene& scene, SceneFindings& findings);

}  // namespace pipelines
