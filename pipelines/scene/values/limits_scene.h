/// What the verdict on a machine asks of it ([limits] of a scene). Values in SI units.
#pragma once

#include <string>
#include <vector>

namespace pipelines {

struct LimitsScene {
  /// Yield strength over the largest stress. FKM guideline, static strength: j_p = 1.5 at severe consequences
  /// and a high probability of the load.
  double yield_safety = 1.5;
  /// Hours of operation that bearings, surfaces and weld toes have to reach. Catalogues of rolling bearings
  /// ask 20,000 to 30,000 h of machines that work eight hours a day at full load.
  double wanted_life_s = 20000 * 3600.0;
  /// Factor that resonance may put on the largest stress.
  double dynamic_amplification = 1.5;
  /// Least distance of an excitation from a natural frequency of a drive train, relative: 10 % (API 671).
  double resonance_margin = 0.1;
  std::vector<std::string> left_out;  ///< criteria that are not weighed (names_of_criteria)
};

/// "yield", "fatigue", "welds", "bearings", "resonance": what a verdict weighs.
inline const std::vector<std::string>& names_of_criteria() {
  static const std::vector<std::string> names{"yield", "fatigue", "welds", "bearings", "resonance"};
  return names;
}

}  // namespace pipelines
