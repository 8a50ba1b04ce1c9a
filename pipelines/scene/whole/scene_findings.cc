#include "pipelines/scene/whole/scene_findings.h"

#include <cmath>
#include <cstdio>

namespace pipelines {

std::string shown(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string Range::rule(double value, const std::string& si_unit) const {
  const std::string unit = si_unit == "1" ? "" : " " + si_unit;
  if (least == 0 && (value < 0 || std::isinf(most)))
    return without_least ? "must be positive" : "must not be negative";
  if (std::isinf(most))
    return std::string("must be ") + (without_least ? "above " : "at least ") + shown(least) + unit;
  if (without_least) return "must be above " + shown(least) + " and at most " + shown(most) + unit;
  return "must lie between " + shown(least) + " and " + shown(most) + unit;
}

}  // namespace pipelines
