/// Names of ports and of own effects that the reader of a body and the maker of its loads share: a misspelt
/// one does not compile.
#pragma once

#include <string>

#include "pipelines/scene/values/effect_names.h"

namespace pipelines {

struct VibratoryShaftNames {
  // Its own effects.
  static constexpr const char *weight = "gravity_shaft", *inertia = effect_name::shaft_inertia;
  // Ports.
  static constexpr const char *seat = "eccentric_seat", *bearing_1 = "main_bearing_1",
                              *bearing_2 = "main_bearing_2", *debalance_1 = "debalance_1",
                              *debalance_2 = "debalance_2", *coupling = "coupling";
  // A quantity that a bearing may give as its load.
  static constexpr const char* bearing_reaction = "R_E_shaft";
};

struct ChamberNames {
  // Ports.
  static constexpr const char *bore = "housing_bore", *wall = "inner_wall";
  /// @param i  from 1, in the order of the machine's springs
  static std::string foot(std::size_t i) { return "spring_foot_" + std::to_string(i); }
};

struct DrumNames {
  static constexpr const char* spin = "drum_spin";  // its own effect
  // Ports.
  static constexpr const char *wall = "inner_wall", *trunnion_1 = "trunnion_1", *trunnion_2 = "trunnion_2",
                              *pulley = "pulley_seat";
};

struct StubAxleNames {
  // Its own effects.
  static constexpr const char *weight = "axle_gravity", *transport = "axle_transport";
  // Ports.
  static constexpr const char *bearing = "bearing", *clamp = "clamp";
};

}  // namespace pipelines
