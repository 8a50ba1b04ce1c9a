#include "pipelines/base/files/json_file.h"

#include <nlohmann/json.hpp>
#include <string>

#include "pipelines/base/files/whole_file.h"

namespace pipelines {
namespace {

using AnyJson = nlohmann::ordered_json;

constexpr int most_levels = 100;  // results have eight

/// Brackets inside brackets, those in texts left out.
bool nests_too_deep(const std::string& text) {
  int level = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text && c == '\\') ++i;  // whatever follows is of the text
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    level += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
    if (level > most_levels) return true;
  }
  return false;
}

}  // namespace

AnyJson read_json_file(const std::filesystem::path& file) {
  AnyJson none(AnyJson::value_t::discarded);
  const auto text = whole_file(file);
  if (!text || nests_too_deep(*text)) return none;
  return AnyJson::parse(*text, nullptr, false);
}

}  // namespace pipelines
