/// The operating points of a sweep: which values its keys take together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipelines/study/variations/variation.h"

namespace pipelines {

enum class SweepDesign {
  grid,             ///< every value of each key with every one of the others; the last key changes fastest
  one_at_a_time,    ///< the scene as it is, then each key by itself
  latin_hypercube,  ///< as many points as asked for; of each key every share of its range is met once
};
/// "grid", "one-at-a-time", "latin-hypercube"
std::string to_string(SweepDesign design);

/// What is asked for, by [sweep] of the scene and the command line.
struct SweepRequest {
  std::vector<std::string> vary;  ///< "KEY = VALUES" each (variation.h)
  SweepDesign design = SweepDesign::grid;
  int n_points = 0;                  ///< points of a Latin hypercube
  std::uint64_t seed = 1;            ///< seed of a Latin hypercube: another seed draws other points
  bool zones = false;                ///< the stress zones of every point, too
  std::vector<std::string> figures;  ///< to print and draw, columns of sweep.csv; none: chosen
};

struct SweepPoint {
  std::vector<std::string> values;    ///< by variation; kept_value: as the scene has it
  std::vector<double> numbers;        ///< by variation, in its unit; NaN where the value is no number
  std::vector<std::string> settings;  ///< "KEY=VALUE" of what is not kept
};

struct SweepPlan {
  std::vector<Variation> variations;
  std::vector<SweepPoint> points;
};

/// @throws OptionError if nothing is varied, a key is varied twice, a range of a grid has no number of
/// values,
///   a Latin hypercube has no number of points, or there are more than a million points
SweepPlan plan_sweep(const SweepRequest& request);

}  // namespace pipelines
