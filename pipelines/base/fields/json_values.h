/// Values of summary.json.
#pragma once

#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "pipelines/base/common/finite.h"

namespace pipelines::summary {

using Json = nlohmann::ordered_json;

/// Keys as pointers: to the library's own lists every length of a text is a type to compile anew.
struct Member {
  const char* key;
  Json value;
};

inline Json object(std::initializer_list<Member> members) {
  Json json = Json::object();
  for (const Member& member : members) json[member.key] = member.value;
  return json;
}

/// @throws NotFinite: no stage leaves such a number, so none is hidden here
inline Json number(double value) {
  require_finite("summary", "a figure of summary.json", value);
  return Json(value);
}

/// A figure that may have no value, and is null then: the safety of a body that nothing stresses, ratios to a
/// load that is not there, errors that are not known (infinite).
inline Json number_or_none(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

inline Json figure(double value, const std::string& unit) {
  return object({{"value", number(value)}, {"unit", unit}});
}

}  // namespace pipelines::summary
