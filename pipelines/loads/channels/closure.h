/// Equilibrium of a body under its channels: before any relief, at every instant, in all six components.
#pragma once

#include <array>
#include <vector>

#include "pipelines/loads/channels/load_collector.h"

namespace pipelines {

/// How far a body is from equilibrium, and how exactly the mesh carries what the channels say.
struct Closure {
  std::array<double, 3> force{};  ///< max over the instants of |sum F_c| / max over the instants of sum |F_c|
  std::array<double, 3> moment{};  ///< the same for moments about the origin
  std::array<double, 3> force_scale_N{}, moment_scale_Nm{};
  /// Max over channels and components of |mesh - wanted| / scale of the channel.
  double channel_resultant = 0;

  static constexpr double limit = 1e-9;  ///< limit of all three, far above rounding and far below any effect

  bool holds() const;
  double worst_force() const;
  double worst_moment() const;
};

/// The resultant (force, moment about the origin) that one unit of a channel must have, from ports and masses
/// alone.
std::array<double, 6> wanted_resultant(const fem::UnitLoad& load, const std::vector<RegionMass>& regions);

/// Closure with the resultants of the load vectors as the mesh has them.
/// A component of the moment is scaled by the sum of |r x F| parts and couples of all channels. Where effects
/// cancel each other nearly, or a load (spin) nearly balances itself, rounding alone is more than the limit
/// of what is left: up to 1024 roundings of what they are made of are judged by that. What spin leaves of a
/// body whose centre of mass is off the axis by less than 1e-5 of its radius of gyration needs no bearings.
/// @param mesh_resultants  K rows: fx, fy, fz, mx, my, mz about the origin for one unit of each channel
/// @throws std::invalid_argument if the two do not have the same channels, or a body force acts on an unknown
/// region
Closure check_closure(const BodyLoads& loads, const std::vector<std::array<double, 6>>& mesh_resultants,
                      const std::vector<RegionMass>& regions);

}  // namespace pipelines
