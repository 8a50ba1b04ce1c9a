/// Zones in words and figures: for terminal, page and sweeps.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

struct NamedShare {
  std::string name;
  double share = 0;
};

/// Shares of effects in sum over their groups (effect_groups.h), in the order of the groups.
/// @param shares  one per effect
std::vector<NamedShare> group_shares(const std::vector<std::string>& effects,
                                     const std::vector<double>& shares);

/// "belt 83 %, drive 17 %": the largest three by size, without those below one percent; "others" has what
/// is left, where that is not below it. Empty without shares.
std::string largest_shares(std::vector<NamedShare> shares);

/// A zone as tables have it, without its moment.
struct ZoneFigures {
  std::string feature, place;
  double peak_Pa = 0;
  double error_Pa = 0;  ///< error of the peak; NaN: not estimated
  double safety = 0;    ///< yield strength / peak
  std::array<double, 3> peak_m{};
  double volume_m3 = 0;
  std::int64_t n_nodes = 0;
};
ZoneFigures figures_of(const Judged& analysis, const Zone& zone);

/// A zone's volume and what it may be off by, in mm3 with the digits that are known.
struct VolumeText {
  std::string volume, error;  ///< "536", "74"; "129", "up to 922"

  /// "536 +- 74", "129, up to 922"
  std::string text() const;
};

/// An error that reaches the volume leaves no zone at all open, and no volume is below zero: then the largest
/// volume that it leaves stands in its place.
/// @param volume_m3  not finite: "-"
/// @param error_m3   to both sides [m3]; none: "-"
VolumeText volume_text(double volume_m3, const std::optional<double>& error_m3);

/// "2 parts at 70 % of the peak, 3 at 90 %". Empty where the zone stays one piece.
std::string parts_text(const Zone& zone);

}  // namespace pipelines
