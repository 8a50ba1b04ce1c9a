/// Rolling bearings under the loads of a cycle: equivalent load and rating life.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/bearing_life.h"
#include "kinetics/load_history.h"
#include "pipelines/loads/channels.h"
#include "pipelines/scene/bearing_scene.h"
#include "pipelines/scene/known_forces.h"

namespace pipelines {

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

/// @throws StageRefused naming bearing, load and remedy if a load is not there
std::vector<BearingResult> bearing_lives(const std::vector<BearingScene>& bearings,
                                         const kinetics::LoadHistory& loads,
                                         const std::vector<const ChannelHistory*>& channels);

}  // namespace pipelines
