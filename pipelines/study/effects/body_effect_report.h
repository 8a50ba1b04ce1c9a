/// What the effects that bodies add are worth, as far as the scene alone can tell: forces that it gives
/// itself. The rest, what a body's own mass brings, comes from its mesh.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "kinetics/values/effect_info.h"
#include "pipelines/base/fields/field.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/search/effect_choice/effect_report.h"

namespace pipelines {

/// Parts of effects in loads: loads.<load> of an effect.
FieldTable<LoadShare> load_share_fields();

/// By load; null without any.
summary::Json load_shares_json(const std::vector<LoadShare>& shares);

void print_load_shares(std::ostream& out, const std::vector<LoadShare>& shares);

/// One effect of one body that is on.
struct BodyEffect {
  std::string body;
  kinetics::EffectInfo effect;
  /// "240 N across, at rest, on pulley_seat"; none: the mesh tells its size.
  std::vector<std::string> forces;
  /// Shares of all such forces on the port: "<body>/<port>.force", "<body>/<port>.fz".
  std::vector<LoadShare> shares;
};

/// Effects of the scene's bodies that are on, in the order of their tables. A force at rest and one that
/// turns with the shaft meet at every angle in the course of time, so that largest sizes add up and squares
/// of root means add up.
std::vector<BodyEffect> effects_of_bodies(const Scene& scene);

/// Forces and shares of each, or where the sizes are to be had that the scene alone cannot tell; nothing if
/// there are none.
/// @param all  with descriptions and sources, as a table each; else a line each
void print_effects_of_bodies(std::ostream& out, const Scene& scene, bool all);

/// JSON of a command with the entry "body_effects" beside its own; as it is if there are none.
std::string with_effects_of_bodies(const std::string& json, const Scene& scene);

/// Largest sums over the cycle of the sizes of all forces, and of all moments, pressure left out.
struct EffectSize {
  std::string effect;
  double force_N = 0, moment_Nm = 0;
};

/// What each effect brings to a meshed body; those that bring nothing are left out.
std::vector<EffectSize> effect_sizes(const BodyLoads& loads, const std::vector<RegionMass>& regions);
FieldTable<EffectSize> effect_size_fields();
void print_effect_sizes(std::ostream& out, const std::vector<EffectSize>& sizes);

}  // namespace pipelines
