/// Words for refusing a shaft.
#pragma once

#include <cstdio>
#include <string>

#include "meshes/values/refused.h"

namespace meshes {

inline std::string mm(double length_m) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g mm", length_m * 1e3);
  return text;
}

[[noreturn]] inline void refuse(const std::string& what) {
  throw GeometryRefused("shaft: " + what);
}

}  // namespace meshes
