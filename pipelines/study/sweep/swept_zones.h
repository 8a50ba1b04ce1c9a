/// Stress zones of the points of a sweep, followed from point to point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/texts/zone_text.h"

namespace pipelines {

struct SweepPlan;
struct SweepRow;

/// A zone (zones.h) at one point, without its nodes.
struct SweptZone : ZoneFigures {
  std::string body;
  std::array<double, 3> low_m{}, high_m{};  ///< the box around its nodes
  std::int64_t instant = 0;                 ///< instant of the peak
};

/// Zones of a body by descending peak.
std::vector<SweptZone> swept_zones(const Judged& analysis);

/// Numbers zones so that those of different points that are one have one number. A zone is that of the
/// nearest earlier point (keys in shares of their range) whose box meets its own, nearest peaks first; where
/// none is left, that of any earlier point, the latest first; else a new one. Meshes may differ from point to
/// point.
/// @return by point and zone: its number, from 1 within its body, in the order of largest peaks
std::vector<std::vector<int>> follow_zones(const SweepPlan& plan, const std::vector<SweepRow>& rows);

/// Adds "bodies.<name>.zones[N].peak", ".peak.error" and ".volume" of the zones that were followed to the
/// rows' figures.
void add_zone_figures(std::vector<SweepRow>& rows, const std::vector<std::vector<int>>& numbers);

}  // namespace pipelines
