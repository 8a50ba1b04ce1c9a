/// The list `effects` of a scene: known names, none twice, none without what it needs.
#pragma once

#include <string>
#include <vector>

#include "pipelines/scene_table.h"

namespace pipelines {

/// The effects that a vibratory mill's scene may name: those of kinetics, then those that come from the
/// body's mesh.
std::vector<std::string> known_effects(kinetics::Convention convention);

/// Reads `effects` of the root table.
/// @param has_shaft  whether the scene has a [shaft]; the effects of its own mass need it
/// @return the names as written, each known, none twice; errors go to the findings
std::vector<std::string> read_effects(SceneTable& root, kinetics::Convention convention, bool has_shaft,
                                      SceneFindings& findings);

}  // namespace pipelines
