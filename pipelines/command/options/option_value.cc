#include "pipelines/command/options/option_value.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/units.h"
#include "pipelines/scene/whole/scene_findings.h"

namespace pipelines {
namespace {

bool is_bare_number(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && std::isfinite(number);
}

}  // namespace

double option_in_si(const char* option, const std::string& text, const std::string& unit) {
  const std::string given = std::string(option) + ' ' + text + ": ";
  const bool is_bare = is_bare_number(text);
  if (is_bare && unit == "1")
    throw OptionError(given + "a share or a percentage? Write \"" + text + " %\" or \"" +
                      shown(100 * std::strtod(text.c_str(), nullptr)) + " %\"");
  if (is_bare && unit != "s")
    throw OptionError(given + "has no unit; write \"" + text + ' ' + unit +
                      "\", or another unit with its number");
  try {
    return to_si(is_bare ? text + " s" : text, unit);
  } catch (const UnitError& error) {
    throw OptionError(given + error.what());
  }
}

double tolerance_option(const std::string& text, const std::string& or_else) {
  const double tolerance = option_in_si("--tolerance", text, "1");
  if (tolerance >= least_tolerance && tolerance <= largest_tolerance) return tolerance;
  throw OptionError("--tolerance " + text + ": must lie between " + shown(100 * least_tolerance) + " and " +
                    shown(100 * largest_tolerance) + " %; write " +
                    (tolerance > 0 ? "one in between" : "a tolerance above 0") + or_else);
}

double time_limit_option(const std::string& text) {
  const double time_limit_s = option_in_si("--time-limit", text, "s");
  if (time_limit_s > 0) return time_limit_s;
  throw OptionError("--time-limit " + text + ": must be positive; write a time above 0, or leave it out");
}

RequestedAccuracy requested_search(const std::string& tolerance, const std::string& time_limit,
                                   RequestedAccuracy scene) {
  RequestedAccuracy accuracy = scene;
  if (tolerance == "none") {
    if (!time_limit.empty())
      throw OptionError(
          "--time-limit " + time_limit +
          ": has no use with --tolerance none, which solves once on the scene's mesh; leave one out");
    accuracy = {};
    accuracy.once = true;
    return accuracy;
  }
  if (!tolerance.empty()) accuracy.tolerance = tolerance_option(tolerance, ", or none");
  if (!time_limit.empty()) accuracy.time_limit_s = time_limit_option(time_limit);
  if (!tolerance.empty() || !time_limit.empty()) accuracy.once = false;
  return accuracy;
}

void require_extension(const char* option, const std::filesystem::path& file,
                       const std::vector<std::string>& extensions, const std::string& remedy) {
  const std::string extension = file.extension().string();
  if (file.empty() || extension.empty() ||
      std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
    return;
  throw OptionError(std::string(option) + ' ' + file.string() + ": " + remedy);
}

}  // namespace pipelines
