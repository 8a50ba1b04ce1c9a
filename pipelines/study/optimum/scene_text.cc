#include "pipelines/study/optimum/scene_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "pipelines/base/files/csv.h"

namespace pipelines {
namespace {

using Kind = TomlNode::Kind;

/// In TOML's double quotes, whose escapes are those of JSON.
std::string in_quotes(const std::string& text) {
  return nlohmann::json(text).dump();
}

std::string key_text(const std::string& key) {
  const auto is_bare = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return !key.empty() && std::all_of(key.begin(), key.end(), is_bare) ? key : in_quotes(key);
}

/// A float has a point or an exponent.
std::string float_text(double number) {
  if (!std::isfinite(number)) return std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
  const auto text = shortest(number);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

/// A value on one line.
std::string value_text(const TomlNode& node) {
  std::string text;
  switch (node.kind) {
    case Kind::text:
      return in_quotes(node.text);
    case Kind::integer:
      return std::to_string(node.integer);
    case Kind::number:
      return float_text(node.number);
    case Kind::boolean:
      return node.boolean ? "true" : "false";
    case Kind::date:
      return node.as_written;
    case Kind::array:
      for (const auto& item : node.items) text += (text.empty() ? "" : ", ") + value_text(item);
      return "[" + text + "]";
    case Kind::table:
      for (const auto& entry : node.entries)
        text += (text.empty() ? "" : ", ") + key_text(entry.key) + " = " + value_text(entry.value);
      return "{ " + text + " }";
  }
  return text;
}

/// An array of tables, each long enough for lines of its own.
bool has_own_headers(const TomlNode& node) {
  return node.kind == Kind::array && node.items.size() > 0 &&
         std::all_of(node.items.begin(), node.items.end(),
                     [](const TomlNode& item) { return item.kind == Kind::table; });
}

/// A list of tables in a list, one a line.
std::string lines_of_tables(const TomlNode& node) {
  std::string text = "[\n";
  for (const auto& item : node.items) text += "  " + value_text(item) + ",\n";
  return text + "]";
}

/// Values first: what follows the header of a table belongs to that.
void add_table(const TomlNode& table, const std::string& name, std::string& text) {
  for (const auto& entry : table.entries)
    if (entry.value.kind != Kind::table)
      text += key_text(entry.key) + " = " +
              (has_own_headers(entry.value) ? lines_of_tables(entry.value) : value_text(entry.value)) + "\n";
  for (const auto& entry : table.entries)
    if (entry.value.kind == Kind::table) {
      const auto own = name + (name.empty() ? "" : ".") + key_text(entry.key);
      text += "\n[" + own + "]\n";
      add_table(entry.value, own, text);
    }
}

void move_files(const std::filesystem::path& from, const std::filesystem::path& to, TomlNode& node) {
  std::error_code none;
  if (node.kind == Kind::text) {
    const std::filesystem::path name(node.text);
    if (name.has_extension() && name.is_relative() && std::filesystem::is_regular_file(from / name, none))
      node.text = std::filesystem::proximate(from / name, to).generic_string();
    return;
  }
  if (!node.items.empty())
    for (auto& item : node.items.own()) move_files(from, to, item);
  if (!node.entries.empty())
    for (auto& entry : node.entries.own()) move_files(from, to, entry.value);
}

}  // namespace

std::string toml_text(const TomlNode& root) {
  std::string text;
  add_table(root, "", text);
  return text;
}

TomlNode with_files_seen_from(const std::filesystem::path& directory, TomlNode root,
                              const std::filesystem::path& scene) {
  move_files(std::filesystem::absolute(scene).parent_path(), std::filesystem::absolute(directory), root);
  return root;
}

}  // namespace pipelines
