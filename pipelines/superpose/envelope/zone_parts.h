/// Zones within zones: the tree of regions at higher and higher levels, so that a large zone does not hide
/// that it has several peaks.
#pragma once

#include <array>
#include <vector>

#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {

/// Levels above that of the zones at which they are looked at again, of the body's peak.
inline constexpr std::array<double, 2> part_levels{0.7, 0.9};

/// Divides zones at the levels of part_levels that are above the zones' own. At each level nodes of a zone at
/// or above it are connected when they share a cell, as those of zones are; a part holds what lies above it
/// at the next level: two peaks are two parts from the level on at which nothing connects them. A zone that
/// no level reaches has no parts.
/// @param zones  zones of this envelope; their numbers and everything else stay
Zones divided(Zones zones, const fem::Nodes& nodes, const NodalMaximum& envelope, const NodePlaces& places);

/// The level from which on a zone is no longer one piece, with its number of parts there; for each level that
/// has more parts than the one before. None where a zone stays one piece.
struct Split {
  double share_of_peak = 0;
  std::size_t n_parts = 0;
};
std::vector<Split> splits_of(const Zone& zone);

}  // namespace pipelines
