#include "pipelines/names/name_fault.h"

#include <algorithm>
#include <cstdio>

namespace pipelines {

std::string control_character_in(const std::string& text) {
  const auto found =
      std::find_if(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (found == text.end()) return {};
  char code[8];
  std::snprintf(code, sizeof code, "U+%04X", static_cast<unsigned char>(*found));
  return std::string("has the control character ") + code + ", which no file can carry; remove it";
}

std::string name_fault(const std::string& name) {
  if (!name.empty() && std::string("=+-@").find(name[0]) != std::string::npos)
    return std::string("begins with \"") + name[0] +
           "\", which a spreadsheet takes for a formula; begin with a letter";
  return control_character_in(name);
}

}  // namespace pipelines
