#include "pipelines/report/html_values.h"

#include <fmt/core.h>

#include <cmath>

#include "pipelines/common/constants.h"

namespace pipelines::html {

std::string number(const Json& value, double factor, const char* format) {
  if (!value.is_number()) return value.is_string() ? value.get<std::string>() : "-";
  const double shown = factor * value.get<double>();
  return std::isfinite(shown) ? fmt::format(fmt::runtime(format), shown) : "-";
}

std::string MPa(const Json& pascals) {
  return number(pascals, 1e-6, "{:.1f}");
}

std::string moment(const Json& at) {
  return fmt::format("turn {}, {} deg", number(at.at("turn"), 1, "{:.0f}"),
                     number(at.at("drive_angle_rad"), 180 / pi, "{:.0f}"));
}

}  // namespace pipelines::html
