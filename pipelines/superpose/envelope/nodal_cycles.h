/// The largest cycle of each node of a surface, for fatigue: streamed like the envelope, no history is
/// stored.
#pragma once

#include <cstdint>
#include <vector>

#include "pipelines/superpose/envelope/stress_cycle.h"

namespace pipelines {

/// What is kept of a node's StressCycle.
struct NodalCycle {
  std::int32_t from, to;
  double amplitude_Pa, signed_mean_Pa;
};

struct NodalCycles {
  std::vector<std::size_t> nodes;
  std::vector<NodalCycle> cycles;  ///< one per node
};

/// The nodes of the body's faces, each once, ascending.
std::vector<std::size_t> surface_nodes(const fem::Nodes& nodes);

/// Finds for each node a cycle by two walks through the instants: along the deviator of its largest stress,
/// then along the difference of the two instants that are farthest apart there. The pair is the exact one
/// where stress is proportional or turns round, and otherwise a lower bound of it, at least the range along
/// both directions; largest_cycle of stress_history is exact. Never above it.
/// @param von_mises  maximum of the envelope: where each walk begins
/// @throws std::invalid_argument if the channels of loads and responses do not agree
NodalCycles nodal_cycles(const ChannelHistory& loads, const fem::UnitResponses& responses,
                         const NodalMaximum& von_mises, std::vector<std::size_t> nodes, int n_threads);

/// Stress at one node at all instants, 6 x instants [Pa].
Eigen::ArrayXXd stress_history_Pa(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                  std::size_t node);

}  // namespace pipelines
