/// A rolling bearing as a scene describes it.
#pragma once

#include <optional>
#include <string>

#include "kinetics/series/bearing_life.h"

namespace pipelines {

/// One entry [[bearings]] of a scene.
struct BearingScene {
  std::string name;
  std::string load;  ///< a quantity ("R_E"), the role of a resultant, or a port of a body
  double share = 1;  ///< share of that load, in (0, 1]
  double dynamic_rating_N = 0;
  kinetics::RollingElement element = kinetics::RollingElement::ball;
  std::optional<double> reliability;      ///< 0.9 to 0.9995: the life that this share of bearings reaches
  std::optional<double> required_life_s;  ///< asks for the rating that lasts so long
  std::optional<double> static_rating_N;  ///< asks for the static safety
  std::optional<kinetics::Lubrication> lubrication;  ///< asks for the modified life
  /// Speed of one ring against the other; default: the drive's mean speed, in a planetary mill the drum's
  /// against the carrier.
  std::optional<double> speed_rad_s;
};

}  // namespace pipelines
