/// Superposition over the cycle: stress(x, t) = sum over k of a_k(t) S_k(x), and its envelope. The history of
/// points times instants is never stored: each point walks through the instants in registers and keeps only
/// what it ends with.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "pipelines/loads/channels/channels.h"

namespace pipelines {

/// Stress tensor, ordered xx, yy, zz, xy, yz, xz [Pa].
using Stress = std::array<double, 6>;

/// sigma_v = sqrt(((xx-yy)^2 + (yy-zz)^2 + (zz-xx)^2)/2 + 3 (xy^2 + yz^2 + xz^2)) [Pa]
double von_mises_Pa(const Stress& stress);

/// Largest principal stress [Pa], tension positive, to rounding of the largest: by the closed form (Smith
/// 1961) where it is exact, else by QR iteration. (Of the closed form, two equal largest principal stresses
/// leave half of the digits; the walk through the instants compares by it.)
double largest_principal_Pa(const Stress& stress);

/// Maximum of each node over the cycle, when it occurs, and the whole tensor at that instant.
struct NodalMaximum {
  std::vector<double> value_Pa;
  std::vector<std::int32_t> instant;  ///< column of ChannelHistory::values
  std::vector<Stress> stress_Pa;
};

struct Envelope {
  NodalMaximum von_mises;
  NodalMaximum principal;  ///< largest principal stress
  /// n_nodes x n_effects: share of each effect in von Mises at its maximum; sums to 1. Single precision: with
  /// many effects shares would be most of the envelope's memory. Of one place: shares_of_stress.
  std::vector<float> effect_share;
};

/// Stress at one node and instant. Called on all ranks that share a body, as UnitResponses::bring.
Stress stress_at(const fem::UnitResponses& responses, const ChannelHistory& loads, std::size_t node,
                 Eigen::Index instant);

/// The same of a node that this rank has.
Stress own_stress_at(const fem::UnitResponses& responses, const ChannelHistory& loads, std::size_t node,
                     Eigen::Index instant);

/// Threads that may ask for the stress of any node at once: one where ranks share the body, and stay in step.
inline int threads_in_step(const fem::UnitResponses& responses, int n_threads) {
  return responses.shared ? 1 : n_threads;
}

/// Whether two histories have one envelope: the same channels and effects with the same values.
bool have_same_values(const ChannelHistory& a, const ChannelHistory& b);

/// Envelope of von Mises and of the largest principal stress over all instants. Beyond the responses and the
/// result it takes memory of a few times the loads, however many nodes there are.
///
/// An effect's share is 3/2 sigma_e : s / sigma_v^2 with s the deviator of the whole stress: it adds up to
/// one over the effects, is negative for an effect that relieves the place, and is zero where nothing is
/// stressed. The walk compares all instants to rounding, by the channels that are independent; of equal ones
/// the first counts. What is kept is computed once more from the stress of that instant.
/// @throws std::invalid_argument if the channels of the two do not agree
Envelope envelope(const ChannelHistory& loads, const fem::UnitResponses& responses, int n_threads);

/// @throws std::invalid_argument if the channels of the two do not agree
void check_channels(const ChannelHistory& loads, const fem::UnitResponses& responses);

class WalkedFactors;

/// The envelope of several bodies, or parts of one, under the same loads: what belongs to the loads is
/// prepared once.
class EnvelopeWalk {
public:
  /// @param loads  outlive this
  explicit EnvelopeWalk(const ChannelHistory& loads);
  /// The envelope, as envelope() has it.
  Envelope of(const fem::UnitResponses& responses, int n_threads) const;

private:
  const ChannelHistory& loads() const;

  const ChannelHistory* loads_;
  ChannelHistory of_unit_size_;  ///< where cubes of the stresses would leave the range of numbers
  double scale_ = 1;
  std::shared_ptr<const WalkedFactors> factors_;
};

/// Displacement of one node at one instant [m], as below. Called as stress_at.
std::array<double, 3> displacement_at(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                      std::size_t node, Eigen::Index instant);
/// The same of a node that this rank has.
std::array<double, 3> own_displacement_at(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                          std::size_t node, Eigen::Index instant);

/// Displacement of every node at one instant, n x 3 [m]; no rigid part in the mass norm.
std::vector<double> displacement_at(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                    Eigen::Index instant);

}  // namespace pipelines
