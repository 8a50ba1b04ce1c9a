#include "pipelines/analysis/served_loads.h"

#include <algorithm>

#include "pipelines/responses/response_key.h"

namespace pipelines {
namespace {

std::string text_of(const fem::UnitLoad& load) {
  return response_key({}, "none", {load}, {}, fem::Solver::automatic, 0);
}

}  // namespace

ServedLoads::ServedLoads(const BodyLoads& solved)
    : channels_(solved.history.channels), unit_loads_(solved.unit_loads) {
  for (const auto& load : unit_loads_) texts_[load.channel] = text_of(load);
}

std::string ServedLoads::missing(const BodyLoads& loads) const {
  for (const auto& load : loads.unit_loads) {
    const auto own = texts_.find(load.channel);
    if (own == texts_.end() || own->second != text_of(load)) return load.channel;
  }
  return "";
}

BodyLoads ServedLoads::with_all_channels(BodyLoads loads) const {
  auto& history = loads.history;
  const bool same = history.channels.size() == channels_.size() &&
                    std::equal(channels_.begin(), channels_.end(), history.channels.begin(),
                               [](const Channel& a, const Channel& b) { return a.name == b.name; });
  if (same) return loads;
  const auto widened = [&](const Eigen::ArrayXXd& values) {
    Eigen::ArrayXXd wide = Eigen::ArrayXXd::Zero(Eigen::Index(channels_.size()), values.cols());
    for (std::size_t k = 0; k < history.channels.size(); ++k) {
      const auto row = std::find_if(channels_.begin(), channels_.end(),
                                    [&](const Channel& c) { return c.name == history.channels[k].name; });
      wide.row(row - channels_.begin()) = values.row(Eigen::Index(k));
    }
    return wide;
  };
  history.values = widened(history.values);
  for (auto& part : history.by_effect) part = widened(part);
  history.channels = channels_;
  loads.unit_loads = unit_loads_;
  return loads;
}

}  // namespace pipelines
