/// Crests between the instants at other points than the one with the largest stress at an instant.
#pragma once

#include <Eigen/Core>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// As many instants that every channel has 24 in a period of its highest line that is 1 % of the largest
/// channel of its unit: a crest between two is then missed by 1 % of that line, (pi / 24)^2 / 2. The
/// trigonometric polynomials through the instants; the history itself has no effects. Its own instants where
/// they are enough, where the window does not close, or where they cannot be transformed.
/// @param most  instants over the history, or twice its own where that is more
ChannelHistory at_denser_instants(const ChannelHistory& loads, Eigen::Index most = 4096);

/// Few instants miss crests by different shares at different points: the largest stress between the instants
/// may be elsewhere. The point that leads at denser instants is judged by time_sampling.h, and what its crest
/// exceeds the peak by becomes the peak's entry time_sampling, where that is more; likewise of weld toes,
/// whose largest has the entry in Judged::hot_spot_errors. So are points that lead at samples of a load
/// table that the instants pass over. Costs nothing where the instants are dense.
void add_crest_elsewhere(Judged& analysis, int n_threads);

/// Instants at which all nodes are superposed: the history's own, and those of add_crest_elsewhere.
Eigen::Index n_superposed(const ChannelHistory& loads);

}  // namespace pipelines
