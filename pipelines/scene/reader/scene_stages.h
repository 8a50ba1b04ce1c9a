/// What a scene says about the stages as a whole, beside its machine and its bodies.
#pragma once

#include <vector>

#include "pipelines/scene/reader/scene_tree.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

/// [sampling]; the period of the machine's motion where no turns are given.
/// @param scene  with its machine read
kinetics::TimeGrid read_sampling(SceneTable sampling, const Scene& scene, SceneFindings& findings);

/// `tolerance` and `time_limit` of the root.
RequestedAccuracy read_requested_accuracy(SceneTable& root);

/// `method` of the root.
/// @param scene  with its bodies read: a body without that model is refused
Method read_method(SceneTable& root, const Scene& scene);

/// Reads [zones].
ZoneRule read_zones(SceneTable zones);

/// Reads [[bearings]].
std::vector<BearingScene> read_bearings(SceneTable& root);

/// Reads [limits].
LimitsScene read_limits(SceneTable limits);

/// Reads [results].
void read_results(SceneTable results, Scene& scene);

/// What the stages themselves refuse (resonances, springs that cannot carry the weights, shafts that cannot
/// be meshed) is better said now, with a line, than after the first stage: a few instants cost next to
/// nothing. Masses that only the mesh knows put that off.
/// @param bodies  the tables of scene.bodies
void rehearse(const Scene& scene, SceneTable& root, SceneTable& machine, std::vector<SceneTable>& bodies,
              const VersionReading& version);

}  // namespace pipelines
