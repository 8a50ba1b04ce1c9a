/// The table [<body>.fatigue] of a scene.
#pragma once

#include "pipelines/scene/bodies/scene_material.h"

namespace pipelines {

/// Reads the body's table `fatigue` into its scene. Fatigue is judged wherever the tensile strength is known;
/// `fatigue = "off"` switches it off. Where the table is left out and the rules refuse something, nothing is
/// judged, and BodyScene::fatigue_missing says why.
/// @param strength  strength of the body's material
/// @param body      with its shape and yield strength; its welds are read, if it is a chamber
/// @param has_run_up  whether the machine has a run-up: then nothing is judged
void read_fatigue(SceneTable& table, const KnownStrength& strength, bool has_run_up, BodyScene& body,
                  SceneFindings& findings);

}  // namespace pipelines
