/// Stress zones of the points of a sweep, followed from point to point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pipelines/analysis/body_analysis.h"

namespace pipelines {

struct SweepPlan;
struct SweepRow;

/// A zone (zones.h) at one point, without its nodes.
struct SweptZone {
  std::string body, feature, place;
  double peak_Pa = 0;
  double error_Pa = 0;  ///< of the peak; NaN: not estimated
  double safety = 0;    ///< yield strength / peak
  std::array<double, 3> peak_m{};
  std::array<double, 3> low_m{}, high_m{};  ///< the box around its nodes
  double volume_m3 = 0;
  std::int64_t instant = 0, n_nodes = 0;
};

/// Descending peak.
std::vector<SweptZone> swept_zones(const BodyAnalysis& analysis);

/// Which zones of different points are one. A zone is that of the nearest earlier point (keys in shares of
/// their range) whose box meets its own, nearest peaks first; where none is left, that of any earlier point,
/// the latest first; else a new one. Meshes may differ from point to point.
/// @return by point and zone: its number, from 1 within its body, in the order of largest peaks
std::vector<std::vector<int>> follow_zones(const SweepPlan& plan, const std::vector<SweepRow>& rows);

/// Adds "bodies.<name>.zones[N].peak", ".peak.error" and ".volume" of the zones that were followed to the
/// rows' figures.
void add_zone_figures(std::vector<SweepRow>& rows, const std::vector<std::vector<int>>& numbers);

}  // namespace pipelines
