/// Channels over time: what each scalar load at a port of one body amounts to, and which effect brings it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace pipelines {

struct Channel {
  std::string name;  ///< "<port>.<component>" without the body
  std::string unit;  ///< SI: "N", "N m", "m/s2" ...
};

/// The channels of one body over the instants of a load history.
struct ChannelHistory {
  std::string body;
  std::vector<Channel> channels;           ///< K
  std::vector<std::string> effects;        ///< E
  Eigen::ArrayXXd values;                  ///< K x n_instants
  std::vector<Eigen::ArrayXXd> by_effect;  ///< E of K x n_instants; sums to values
  /// K x loads between the instants that these do not tell: samples of a table, a train's fastest harmonics
  /// (MachineKind::loads_passed_over); no columns: none.
  Eigen::ArrayXXd passed_over{};
  std::vector<Eigen::ArrayXXd> passed_over_by_effect{};  ///< E of the same; sums to passed_over
};

}  // namespace pipelines
