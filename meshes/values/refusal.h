/// Words for refusing a shaft.
#pragma once

#include <sstream>
#include <string>

#include "meshes/values/refused.h"

namespace meshes {

inline std::string mm(double length_m) {
  std::ostringstream text;
  text.precision(12);
  text << length_m * 1e3 << " mm";
  return text.str();
}

[[noreturn]] inline void refuse(const std::string& what) {
  throw GeometryRefused("shaft: " + what);
}

}  // namespace meshes
