/// The places of a body that a page leads to: what governs, zones, weld toes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

struct PagePlace {
  std::string kind;  ///< "governing", "zone", "toe"
  std::string name;
  std::string note;  ///< "free surface"
  std::array<double, 3> position_m{};
  double value_Pa = 0;
  double error_Pa = -1;  ///< negative: not estimated
  std::int32_t instant = 0;
  StressPoint point;  ///< whose unit stress gives its course
};

/// What governs first; at most so many zones and toes as people look at.
std::vector<PagePlace> page_places(const Judged& analysis);

}  // namespace pipelines
