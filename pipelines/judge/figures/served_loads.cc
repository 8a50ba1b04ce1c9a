#include "pipelines/judge/figures/served_loads.h"

#include <algorithm>

#include "pipelines/loads/stage/start_up_loads.h"
#include "pipelines/respond/responses/response_key.h"

namespace pipelines {

ServedLoads::ServedLoads(const BodyLoads& solved)
    : channels_(solved.history.channels), unit_loads_(solved.unit_loads) {
  for (const auto& load : unit_loads_) texts_[load.channel] = load_key(load);
}

std::string ServedLoads::missing(const BodyLoads& loads) const {
  for (const auto& load : loads.unit_loads) {
    const auto own = texts_.find(load.channel);
    if (own == texts_.end() || own->second != load_key(load)) return load.channel;
  }
  return "";
}

BodyLoads ServedLoads::with_all_channels(BodyLoads loads) const {
  const auto& history = loads.history;
  const bool same = history.channels.size() == channels_.size() &&
                    std::equal(channels_.begin(), channels_.end(), history.channels.begin(),
                               [](const Channel& a, const Channel& b) { return a.name == b.name; });
  if (same) return loads;
  take_channels(loads, channels_, unit_loads_);
  return loads;
}

}  // namespace pipelines
