#include "pipelines/peak_growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pipelines/refinement.h"

namespace pipelines {

bool PeakGrowth::at(const BodyAnalysis& analysis, double ratio) {
  if (!analysis.hot_spots.empty()) return false;
  if (analysis.peak.feature != feature_) {
    values_.clear();
    ratios_.clear();
    feature_ = analysis.peak.feature;
  } else {
    ratios_.push_back(ratio);
  }
  values_.push_back(analysis.peak.value_Pa);
  const bool grows = grows_without_bound(values_, ratios_);
  if (grows) feature_.clear();
  return grows;
}

double diagonal_m(const fem::Nodes& nodes) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (std::size_t i = 0; i < nodes.n; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], nodes.xyz_m[3 * i + c]);
      high[c] = std::max(high[c], nodes.xyz_m[3 * i + c]);
    }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

}  // namespace pipelines
