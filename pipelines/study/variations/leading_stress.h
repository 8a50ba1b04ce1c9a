/// The largest stress of every place of a body under many load cases on one set of unit responses, without a
/// walk over all nodes for each.
///
/// Von Mises stress is a norm of the stress tensor, and stress is linear in the channels a_k(t). With the
/// channels a0_k(t) of a case whose envelope is known and any factor c, a node's stress is at most
///
///     reach = |c| envelope0 + sum over k of  max over t |a_k(t) - c a0_k(t)| * sigma_v(S_k)
///
/// which needs no walk through the instants. Of each place the nodes are taken by what they can reach, until
/// no other one can lead. The result is exact: nodes are only left out where they cannot hold the maximum.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pipelines/superpose/envelope/superposed.h"

namespace pipelines {

class LeadingStress {
public:
  /// @param known  with the whole envelope
  explicit LeadingStress(const Superposed& known);

  /// Takes for each feature the node with the largest von Mises stress outside the exclusion distances, and
  /// for the inside where it is at least nine tenths of that (place_stress.h), as a whole envelope has them,
  /// bit for bit. Other nodes are as well or are zero. No largest principal stress, no shares of effects
  /// elsewhere.
  /// @param loads  with the channels of the responses
  Envelope envelope(const ChannelHistory& loads, const fem::UnitResponses& responses) const;

  /// Adds to such an envelope every node that is at or above a level, and all others of their cells: the
  /// zones above that level (zones.h) are those of a whole envelope, bit for bit.
  void complete_above(double level_Pa, const ChannelHistory& loads, const fem::UnitResponses& responses,
                      Envelope& leading) const;

private:
  Eigen::ArrayXd reach(const ChannelHistory& loads) const;

  std::vector<std::vector<std::int32_t>> places_;  ///< nodes by feature, those on seams in several
  std::vector<std::int32_t> inside_;
  Eigen::ArrayXXd channels_;    ///< channels of the known case, K x instants
  Eigen::ArrayXd known_Pa_;     ///< its envelope, per node
  std::vector<char> excluded_;  ///< per node: belongs to no place and no zone
  Eigen::MatrixXd unit_Pa_;     ///< von Mises stress of the unit stresses, nodes x K
  Eigen::ArrayXd weight_;       ///< per channel: the largest of that, to compare channels by
};

}  // namespace pipelines
