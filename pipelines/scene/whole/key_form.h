/// What may stand under a key of a scene, as its reader asks for it: a schema of scenes is made of these
/// (scene_schema.h).
#pragma once

#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace pipelines {

struct KeyForm {
  enum class Kind { quantity, quantities, count, flag, text, texts, list, table, tables };
  Kind kind;
  std::string si_unit{};  ///< of quantities
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool without_least = false;  ///< least itself is refused

  bool operator==(const KeyForm& other) const {
    return kind == other.kind && si_unit == other.si_unit && least == other.least && most == other.most &&
           without_least == other.without_least;
  }
};

/// Names are dotted, items of arrays have no number: "shaft.contour[].diameter".
struct KeyForms {
  std::map<std::string, std::vector<KeyForm>> of_keys;  ///< no form: anything may stand there
  std::set<std::string> closed;                         ///< tables that have no other keys; "": the scene
};

}  // namespace pipelines
