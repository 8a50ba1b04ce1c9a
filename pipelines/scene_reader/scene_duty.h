/// Reading [[duty]].
#pragma once

#include "pipelines/scene/scene_table.h"
#include "pipelines/scene_reader/scene_tree.h"

namespace pipelines {

/// Reads the blocks, each a version of the scene with the keys of its table `set`.
/// @param root   of `tree`
/// @param scene  read up to here, without errors; gets its blocks
void read_duty(SceneTable& root, const TomlNode& tree, Scene& scene, SceneFindings& findings);

}  // namespace pipelines
