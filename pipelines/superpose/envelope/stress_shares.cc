#include "pipelines/superpose/envelope/stress_shares.h"

#include <algorithm>

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::VectorXd;

/// @param at  takes the factors of the channels (K) from their history (K x instants)
template <typename At>
StressShares shares_by(const UnitStresses& unit_Pa, const ChannelHistory& loads, const At& at) {
  StressShares shares;
  shares.effects.assign(loads.effects.size(), 0.0);
  shares.channels.assign(loads.channels.size(), 0.0);
  const VectorXd factors = at(loads.values);
  const Eigen::Matrix<double, 6, 1> whole_Pa = unit_Pa * factors;
  Stress stress;
  std::copy_n(whole_Pa.data(), 6, stress.begin());
  const double sigma_v = von_mises_Pa(stress);
  if (!(sigma_v > 0)) return shares;
  // Divided before it is multiplied: squares of the stress may leave the range of numbers.
  const double mean = whole_Pa.head<3>().mean();
  Eigen::Matrix<double, 6, 1> direction = whole_Pa;
  direction.head<3>().array() -= mean;
  direction *= 1.5 / sigma_v;
  direction.tail<3>() *= 2;  // each shear component stands twice in the tensor
  const VectorXd by_channel = unit_Pa.transpose() * direction / sigma_v;
  for (std::size_t k = 0; k < shares.channels.size(); ++k)
    shares.channels[k] = by_channel[Eigen::Index(k)] * factors[Eigen::Index(k)];
  for (std::size_t e = 0; e < shares.effects.size(); ++e)
    shares.effects[e] = by_channel.dot(at(loads.by_effect[e]));
  return shares;
}

}  // namespace

UnitStresses unit_stresses_at(const fem::UnitResponses& responses, std::size_t node) {
  return Eigen::Map<const UnitStresses>(responses.stress_anywhere_Pa(node), 6,
                                        Eigen::Index(responses.channels.size()));
}

StressShares shares_of_stress(const UnitStresses& unit_Pa, const ChannelHistory& loads,
                              Eigen::Index instant) {
  return shares_by(unit_Pa, loads, [&](const ArrayXXd& values) -> VectorXd { return values.col(instant); });
}

StressShares shares_of_change(const UnitStresses& unit_Pa, const ChannelHistory& loads, Eigen::Index from,
                              Eigen::Index to) {
  return shares_by(unit_Pa, loads,
                   [&](const ArrayXXd& values) -> VectorXd { return values.col(to) - values.col(from); });
}

}  // namespace pipelines
