#include "pipelines/base/common/finite.h"

#include <fmt/core.h>

#include <cmath>

#include "pipelines/base/common/errors.h"

namespace pipelines {

namespace {

const char* const remedy =
    "the scene's numbers are too large or too small for each other: look for a value with a wrong unit or "
    "exponent";

}  // namespace

void refuse_not_finite(const std::string& stage, const std::string& what, const std::string& where) {
  throw NotFinite(fmt::format("{}: {} is not finite{}; {}", stage, what, where, remedy));
}

void require_finite(const std::string& stage, const std::string& what, double value) {
  if (!std::isfinite(value)) refuse_not_finite(stage, what, "");
}

}  // namespace pipelines
