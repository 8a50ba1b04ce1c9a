#include "pipelines/commands/option_value.h"

#include <algorithm>
#include <cstdlib>

#include "pipelines/common/errors.h"
#include "pipelines/common/units.h"
#include "pipelines/scene/scene_findings.h"

namespace pipelines {
namespace {

bool is_bare_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0';
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
  if (!tolerance.empty()) accuracy.tolerance = option_in_si("--tolerance", tolerance, "1");
  if (!time_limit.empty()) accuracy.time_limit_s = option_in_si("--time-limit", time_limit, "s");
  if (!tolerance.empty() || !time_limit.empty()) accuracy.once = false;
  if (accuracy.tolerance < 0 || accuracy.tolerance > 1)
    throw OptionError("--tolerance " + tolerance + ": must lie between 0 and 100 %");
  if (accuracy.time_limit_s < 0) throw OptionError("--time-limit " + time_limit + ": is negative");
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
