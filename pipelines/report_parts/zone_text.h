/// What brings a zone, in words: for the table on the terminal and the page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/analysis/body_analysis.h"

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

/// "by belt 83 %, drive 17 %; amplitude 41.9 MPa by belt 100 %", by groups, and where fatigue is asked for
/// "; damage by belt 100 %". Empty where there is one group
/// only, or nothing known of the zone.
/// @param zone  index
std::string causes_text(const BodyAnalysis& analysis, std::size_t zone);

/// A zone's volume and what it may be off by, in mm3 with the digits that are known.
struct VolumeText {
  std::string volume, error;  ///< "536", "74"; "129", "up to 922"
};

/// An error that reaches the volume leaves no zone at all open, and no volume is below zero: then the largest
/// volume that it leaves stands in its place.
/// @param volume_m3  not finite: "-"
/// @param error_m3   to both sides [m3]; none: "-"
VolumeText volume_text(double volume_m3, const std::optional<double>& error_m3);

/// "2 parts at 70 % of the peak, 3 at 90 %". Empty where the zone stays one piece.
std::string parts_text(const Zone& zone);

}  // namespace pipelines
