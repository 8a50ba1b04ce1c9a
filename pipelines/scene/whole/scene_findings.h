/// What reading a scene brings to light besides its values, and the rules that values have to keep.
#pragma once

#include <limits>
#include <set>
#include <string>
#include <vector>

#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Everything that reading a scene brings to light.
struct SceneFindings {
  std::string file;
  std::vector<SceneFinding> errors;
  std::vector<DefaultUsed> defaults;
  std::vector<std::string> warnings;
  bool are_noted = true;       ///< defaults, keys and forms; else these stay empty
  std::set<std::string> keys;  ///< every key that the reader knows here, dotted, items counted from 1
  KeyForms forms;
};

/// The values that a quantity may take, in SI.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool without_least = false;  ///< least itself is refused

  bool contains(double value) const {
    return value <= most && (without_least ? value > least : value >= least);
  }
  /// What is wrong with a value outside: "must be positive", "must lie between 0 and 0.1 m" ...
  std::string rule(double value, const std::string& si_unit) const;
};

inline Range positive(double most = std::numeric_limits<double>::infinity()) {
  return {0, most, true};
}
inline Range not_negative(double most = std::numeric_limits<double>::infinity()) {
  return {0, most, false};
}
inline Range between(double least, double most) {
  return {least, most, false};
}
/// Range of angles in rad that may be of many turns: beyond, a double has no ten digits of the last turn
/// left.
inline Range any_angle() {
  return between(-1e6, 1e6);
}

/// A number as an engineer writes it: "9.81", "-0.05".
/// @param digits  significant digits at most
std::string shown(double value, int digits = 12);

}  // namespace pipelines
