/// The table [<body>.fatigue] of a scene.
#pragma once

#include <optional>

#include "pipelines/scene/scene_table.h"
#include "pipelines/scene_values/fatigue_scene.h"

namespace pipelines {

/// Reads the body's table `fatigue`; nothing where it has none: fatigue is judged where the scene asks.
/// @param yield_strength_Pa  of the body's material
/// @param has_welds  a chamber: the table `welds` is read
std::optional<FatigueScene> read_fatigue(SceneTable& body, double yield_strength_Pa, bool has_welds);

}  // namespace pipelines
