/// Which loads the unit responses of a body serve, beside those that they were solved for.
#pragma once

#include <map>
#include <string>

#include "pipelines/loads/channels/load_collector.h"

namespace pipelines {

class ServedLoads {
public:
  /// @param solved  whose unit responses there are
  explicit ServedLoads(const BodyLoads& solved);

  /// The first channel whose unit load was not solved; empty: all were.
  std::string missing(const BodyLoads& loads) const;

  /// The loads with all channels that were solved, in their order; those that they lack are zero.
  /// @param loads  without missing channels
  BodyLoads with_all_channels(BodyLoads loads) const;

private:
  std::vector<Channel> channels_;
  std::vector<fem::UnitLoad> unit_loads_;
  std::map<std::string, std::string> texts_;  ///< texts of the unit loads by channel
};

}  // namespace pipelines
