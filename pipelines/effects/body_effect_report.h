/// What the effects that bodies add are worth, as far as the scene alone can tell: forces that it gives
/// itself. The rest, what a body's own mass brings, comes from its mesh.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "kinetics/values/effect_info.h"
#include "pipelines/channels/load_collector.h"
#include "pipelines/effects/effect_report.h"
#include "pipelines/scene/scene.h"

namespace pipelines {

/// One effect of one body that is on.
struct BodyEffect {
  std::string body;
  kinetics::EffectInfo effect;
  std::vector<std::string>
      forces;  ///< "240 N across, at rest, on pulley_seat"; none: the mesh tells its size
  std::vector<LoadShare>
      shares;  ///< of all such forces on the port: "<body>/<port>.force", "<body>/<port>.fz"
};

/// Effects of the scene's bodies that are on, in the order of their tables. A force at rest and one that
/// turns with the shaft meet at every angle in the course of time, so that largest sizes add up and squares
/// of root means add up.
std::vector<BodyEffect> effects_of_bodies(const Scene& scene);

/// A line each, and where the sizes are to be had that the scene alone cannot tell; nothing if there are
/// none.
void print_effects_of_bodies(std::ostream& out, const Scene& scene);

/// JSON of a command with the entry "body_effects" beside its own; as it is if there are none.
std::string with_effects_of_bodies(const std::string& json, const Scene& scene);

/// What each effect brings to a meshed body: its largest sum of forces and of moments, pressure left out.
void print_effect_sizes(std::ostream& out, const BodyLoads& loads, const std::vector<RegionMass>& regions);

}  // namespace pipelines
