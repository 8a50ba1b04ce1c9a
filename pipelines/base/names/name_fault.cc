#include "pipelines/base/names/name_fault.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace pipelines {
namespace {

/// Characters of a UTF-8 text; what is no UTF-8 counts byte by byte.
std::vector<std::uint32_t> characters_of(const std::string& text) {
  std::vector<std::uint32_t> characters;
  int n_left = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (n_left > 0 && (byte & 0xC0) == 0x80) {
      characters.back() = characters.back() << 6 | (byte & 0x3Fu);
      --n_left;
      continue;
    }
    n_left = byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : byte >= 0xC0 ? 1 : 0;
    characters.push_back(n_left == 0 ? byte : byte & (0x3Fu >> n_left));
  }
  return characters;
}

/// Control characters, ends of lines and paragraphs, changes of the direction of writing (Unicode 15, table
/// 23-1 and section 23.2), and what is no character.
bool is_no_text(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029 || (c >= 0x202A && c <= 0x202E) ||
         (c >= 0x2066 && c <= 0x2069) || (c & 0xFFFEu) == 0xFFFEu;
}

}  // namespace

std::string control_character_in(const std::string& text) {
  const auto characters = characters_of(text);
  const auto found = std::find_if(characters.begin(), characters.end(), is_no_text);
  if (found == characters.end()) return {};
  char code[16];
  std::snprintf(code, sizeof code, "U+%04X", unsigned(*found));
  return std::string("has the control character ") + code + ", which no file can carry; remove it";
}

std::string cell_fault(const std::string& text) {
  if (!text.empty() && std::string("=+-@").find(text[0]) != std::string::npos)
    return std::string("begins with \"") + text[0] +
           "\", which a spreadsheet takes for a formula; begin with a letter";
  return control_character_in(text);
}

std::string name_fault(const std::string& name) {
  constexpr std::size_t longest = 100;
  if (auto fault = cell_fault(name); !fault.empty()) return fault;
  if (characters_of(name).size() > longest || name.find('"') != std::string::npos)
    return "has quotes or more than 100 characters, which meshes cannot carry; take a short name";
  if (name == "." || name == ".." || name.find('/') != std::string::npos)
    return "is \".\", \"..\" or has a \"/\", as paths in files have; take a name without";
  return {};
}

}  // namespace pipelines
