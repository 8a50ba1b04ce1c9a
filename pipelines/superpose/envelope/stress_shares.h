/// What brings a stress, or its change between two instants: shares of the effects and of the channels.
///
/// The share of a part p in a stress s is 3/2 p : dev(s) / sigma_v(s)^2. Shares of all parts add up to one,
/// and one that is negative relieves. A share is the derivative of the logarithm of von Mises stress by the
/// part's size: with the part times 1 - h, sigma_v falls by h times the share, to first order.
///
/// The amplitude of a cycle is half of the von Mises stress of its change, and has the shares of that. Since
/// the cycle is the largest one, the other instants that a change of loads may lead to matter in second order
/// only. Damage by an S-N line of slope k goes with the amplitude to the power k: with the part times 1 - h
/// it falls by h k times the share, to first order.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "pipelines/loads/channels/channels.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {

/// Unit stresses of one place, a column (xx, yy, zz, xy, yz, xz) for each channel [Pa per unit].
using UnitStresses = Eigen::Matrix<double, 6, Eigen::Dynamic>;

struct StressShares {
  std::vector<double> effects;   ///< in the order of ChannelHistory::effects; they sum to one
  std::vector<double> channels;  ///< in the order of ChannelHistory::channels; they sum to one
};

/// Unit stresses of a node.
UnitStresses unit_stresses_at(const fem::UnitResponses& responses, std::size_t node);

/// Shares in the stress at one instant. Zeros where its von Mises stress is zero.
StressShares shares_of_stress(const UnitStresses& unit_Pa, const ChannelHistory& loads, Eigen::Index instant);

/// Shares in the change of stress between two instants, in either order. Zeros where it has no von Mises
/// stress.
StressShares shares_of_change(const UnitStresses& unit_Pa, const ChannelHistory& loads, Eigen::Index from,
                              Eigen::Index to);

}  // namespace pipelines
