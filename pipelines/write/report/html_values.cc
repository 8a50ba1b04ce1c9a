#include "pipelines/write/report/html_values.h"

#include <fmt/core.h>

#include <cmath>

namespace pipelines::html {

std::string number(const Json& value, double factor, const char* format) {
  if (!value.is_number()) return value.is_string() ? value.get<std::string>() : "-";
  const double shown = factor * value.get<double>();
  return std::isfinite(shown) ? fmt::format(fmt::runtime(format), shown) : "-";
}

std::string MPa(const Json& pascals) {
  return number(pascals, 1e-6, "{:.1f}");
}

}  // namespace pipelines::html
