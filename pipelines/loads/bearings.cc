#include "pipelines/loads/bearings.h"

#include <algorithm>

#include "pipelines/common/errors.h"
#include "pipelines/common/nearest_name.h"

namespace pipelines {
namespace {

/// Of a channel "<port>.<component>"; empty if there is none.
std::optional<Eigen::ArrayXd> channel(const ChannelHistory& channels, const std::string& name) {
  for (std::size_t k = 0; k < channels.channels.size(); ++k)
    if (channels.channels[k].name == name) return channels.values.row(Eigen::Index(k)).transpose();
  return std::nullopt;
}

double speed_of(const BearingScene& bearing, const kinetics::LoadHistory& loads) {
  if (bearing.speed_rad_s) return *bearing.speed_rad_s;
  for (const auto& quantity : loads.quantities)
    if (quantity.name == "drum_relative_speed") return quantity.values.abs().mean();
  return loads.speed_rad_s.abs().mean();
}

}  // namespace

std::optional<Eigen::ArrayXd> force_of(const std::string& load, const kinetics::LoadHistory& loads,
                                       const std::vector<const ChannelHistory*>& channels) {
  for (const auto* body : channels) {
    const auto fx = channel(*body, load + ".fx"), fy = channel(*body, load + ".fy");
    if (fx && fy) return (fx->square() + fy->square()).sqrt();
    if (fx || fy) return (fx ? *fx : *fy).abs();  // the other one is never fed
  }
  return force_of(load, loads);
}

std::vector<BearingResult> bearing_lives(const std::vector<BearingScene>& bearings,
                                         const kinetics::LoadHistory& loads,
                                         const std::vector<const ChannelHistory*>& channels) {
  std::vector<BearingResult> results;
  for (const auto& bearing : bearings) {
    const auto force = force_of(bearing.load, loads, channels);
    if (!force)
      throw StageRefused("bearing \"" + bearing.name + "\": there is no force \"" + bearing.load +
                         "\"; known here: " + listed(known_forces(loads)) +
                         (channels.empty() ? ", and with `run` the ports of the bodies" : ""));
    BearingResult result;
    result.name = bearing.name;
    result.load = bearing.load;
    const Eigen::ArrayXd part = bearing.share * *force;
    result.largest_load_N = part.maxCoeff();
    result.equivalent_load_N = kinetics::equivalent_load_N(part, bearing.element);
    result.speed_rad_s = speed_of(bearing, loads);
    result.life = kinetics::rating_life(bearing.dynamic_rating_N, result.equivalent_load_N, bearing.element,
                                        result.speed_rad_s);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace pipelines
