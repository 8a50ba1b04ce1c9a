/// Superposition over the cycle: stress(x, t) = sum over k of a_k(t) S_k(x), and its envelope. The history of
/// points times instants is never stored: each point walks through the instants in registers and keeps only
/// what it ends with.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fem/values/unit_responses.h"
#include "pipelines/loads/channels.h"

namespace pipelines {

/// Stress tensor, ordered xx, yy, zz, xy, yz, xz [Pa].
using Stress = std::array<double, 6>;

/// sigma_v = sqrt(((xx-yy)^2 + (yy-zz)^2 + (zz-xx)^2)/2 + 3 (xy^2 + yz^2 + xz^2)) [Pa]
double von_mises_Pa(const Stress& stress);

/// Largest principal stress [Pa], tension positive; by QR iteration, to rounding of the largest. (Of the
/// closed form, Smith 1961, two equal principal stresses leave half of the digits; the walk through the
/// instants compares by it.)
double largest_principal_Pa(const Stress& stress);

/// Per node the maximum over the cycle, when it occurs, and the whole tensor at that instant.
struct NodalMaximum {
  std::vector<double> value_Pa;
  std::vector<std::int32_t> instant;  ///< column of ChannelHistory::values
  std::vector<Stress> stress_Pa;
};

struct Envelope {
  NodalMaximum von_mises;
  NodalMaximum principal;  ///< largest principal stress
  std::vector<double>
      effect_share;  ///< n_nodes x n_effects: share of each effect in von Mises at its maximum; sums to 1
};

/// Stress at one node and instant.
Stress stress_at(const fem::UnitResponses& responses, const ChannelHistory& loads, std::size_t node,
                 Eigen::Index instant);

/// Envelope of von Mises and of the largest principal stress over all instants.
///
/// An effect's share is 3/2 sigma_e : s / sigma_v^2 with s the deviator of the whole stress: it adds up to
/// one over the effects, is negative for an effect that relieves the place, and is zero where nothing is
/// stressed. The walk compares all instants to rounding; of equal ones the first counts. What is kept is
/// computed once more from the stress of that instant.
/// @throws std::invalid_argument if the channels of the two do not agree
Envelope envelope(const ChannelHistory& loads, const fem::UnitResponses& responses, int n_threads);

/// Displacement of every node at one instant, n x 3 [m]; no rigid part in the mass norm.
std::vector<double> displacement_at(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                    Eigen::Index instant);

}  // namespace pipelines
