/// Rolling bearings under the loads of a cycle: equivalent load and rating life.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/bearing_life.h"
#include "kinetics/load_history.h"
#include "pipelines/loads/channels.h"

namespace pipelines {

/// One entry [[bearings]] of a scene.
struct BearingScene {
  std::string name;
  std::string load;  ///< a quantity ("R_E"), the role of a resultant, or a port of a body
  double share = 1;  ///< of that load, in (0, 1]
  double dynamic_rating_N = 0;
  kinetics::RollingElement element = kinetics::RollingElement::ball;
  std::optional<double> speed_rad_s;  ///< of one ring against the other; default: the drive's mean speed, in
                                      ///< a planetary mill the drum's against the carrier
};

struct BearingResult {
  std::string name, load;
  double equivalent_load_N = 0, largest_load_N = 0;
  double speed_rad_s = 0;
  std::optional<kinetics::RatingLife> life;  ///< empty: never loaded
};

/// Force of a load over the cycle [N]; empty if there is none of that name.
/// @param channels  of the bodies, in the order in which they are asked; none: the load stage alone
std::optional<Eigen::ArrayXd> force_of(const std::string& load, const kinetics::LoadHistory& loads,
                                       const std::vector<const ChannelHistory*>& channels);

/// The names that force_of knows without a body.
std::vector<std::string> known_forces(const kinetics::LoadHistory& loads);

/// @throws StageRefused naming bearing, load and remedy if a load is not there
std::vector<BearingResult> bearing_lives(const std::vector<BearingScene>& bearings,
                                         const kinetics::LoadHistory& loads,
                                         const std::vector<const ChannelHistory*>& channels);

}  // namespace pipelines
