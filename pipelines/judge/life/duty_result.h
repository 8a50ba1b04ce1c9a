/// What operating blocks come to: stresses of each block, damage and life over all of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipelines/judge/life/duty_fatigue.h"
#include "pipelines/loads/channels/bearings.h"

namespace pipelines {

/// Largest von Mises stress of a body in a block: outside the exclusion distances, or at a weld toe.
struct BlockStress {
  std::string body, feature;
  bool is_hot_spot = false;  ///< structural stress of a weld toe
  double value_Pa = 0;
  double safety = 0;             ///< yield strength over it
  double sampling_error_Pa = 0;  ///< by how much it may be larger between the instants (time_sampling.h)
};

struct BlockResult {
  std::string name;
  double share = 0;            ///< share of all time
  double starts_per_day = 0;   ///< starts in a day, standstill included
  bool has_transient = false;  ///< a start was followed over time; else it goes from rest to running at once
  std::vector<BlockStress> stresses;    ///< in the order of Scene::bodies
  std::vector<BearingResult> bearings;  ///< in the order of Scene::bearings
};

/// A bearing over all blocks. Lives are in operation.
struct DutyBearing {
  std::string name;
  double equivalent_load_N = 0;  ///< by turns: (sum n P^p / sum n)^(1/p)
  std::optional<double> life_h;  ///< L10h by sum of shares / lives; none: never loaded
  /// Modified life by sum of shares / lives, where the scene asks for it.
  std::optional<double> modified_life_h;
};

struct DutyResult {
  double in_operation = 0;  ///< share of all time, the sum of the blocks'
  std::vector<BlockResult> blocks;
  std::map<std::string, std::vector<DutyPlace>> places;  ///< by body whose fatigue the scene asks for
  /// Effects that the shares of these places belong to, by body.
  std::map<std::string, std::vector<std::string>> effects;
  std::vector<DutyBearing> bearings;
  /// Warnings of the blocks' loads that the scene's own running does not have.
  std::vector<std::string> warnings;
};

/// @param blocks  with bearings
std::vector<DutyBearing> bearings_over_blocks(const std::vector<BlockResult>& blocks,
                                              const std::vector<BearingScene>& bearings);

}  // namespace pipelines
