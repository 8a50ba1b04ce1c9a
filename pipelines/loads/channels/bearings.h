/// Rolling bearings under the loads of a cycle: equivalent load and rating life.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/series/bearing_life.h"
#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/channels.h"
#include "pipelines/scene/values/bearing_scene.h"
#include "pipelines/scene/values/known_forces.h"

namespace pipelines {

/// What a scene asks of a bearing beyond L10; empty what it does not ask, or what has no load to follow from.
struct BearingAnswers {
  std::optional<double> reliability;          ///< reliability that the lives below belong to
  std::optional<double> a1, a_iso;            ///< factors of ISO 281
  std::optional<double> modified_life_h;      ///< a1 a_ISO L10h
  std::optional<double> required_life_h;      ///< as the scene has it
  std::optional<double> required_rating_N;    ///< dynamic, by ISO 281 with the factors above
  std::optional<double> weibull_rating_N;     ///< dynamic, by the catalogues' Weibull law (Shigley, ch. 11)
  std::optional<double> weibull_reliability;  ///< with which the bearing reaches the required life, same law
  std::optional<double> static_safety;        ///< static rating over the largest load
};

struct BearingResult {
  std::string name, load;
  double equivalent_load_N = 0, largest_load_N = 0;
  double speed_rad_s = 0;
  std::optional<kinetics::RatingLife> life;  ///< empty: never loaded
  BearingAnswers answers{};
};

/// The answers as lines of the terminal, each with the rule that gave it; none if nothing was asked.
std::vector<std::string> answer_lines(const BearingAnswers& answers);

/// Force of a load over the cycle [N]; empty if there is none of that name.
/// @param channels  channels of the bodies, in the order in which they are asked; none: the load stage alone
std::optional<Eigen::ArrayXd> force_of(const std::string& load, const kinetics::LoadHistory& loads,
                                       const std::vector<const ChannelHistory*>& channels);

/// @throws StageRefused naming bearing, load and remedy if a load is not there
std::vector<BearingResult> bearing_lives(const std::vector<BearingScene>& bearings,
                                         const kinetics::LoadHistory& loads,
                                         const std::vector<const ChannelHistory*>& channels);

/// Warns of bearings whose equivalent load is more than half of their dynamic rating: so far the life law of
/// ISO 281 reaches, and beyond it rings and rolling elements yield.
/// @param results  results of bearing_lives of these bearings, in the same order
/// @param loads    get the warnings
void warn_beyond_ratings(const std::vector<BearingScene>& bearings, const std::vector<BearingResult>& results,
                         kinetics::LoadHistory& loads);

/// Sentences on bearings whose port has a force along the shaft that ISO 281 would count: their loads are
/// those across it.
/// @param results  results of bearing_lives with these channels
std::vector<std::string> forces_along_bearings(const std::vector<BearingResult>& results,
                                               const std::vector<const ChannelHistory*>& channels);

}  // namespace pipelines
