/// A TOML text as a tree of plain values, each with its place in the file. The only door to toml++.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "pipelines/base/files/shared_list.h"

namespace pipelines {

/// 1-based; columns count characters, not bytes. 0:0 means the file as a whole.
struct SourcePosition {
  int line = 0, column = 0;
};

struct TomlEntry;

/// One value. Which member counts is said by `kind`. Copies share what is below them until it is changed.
struct TomlNode {
  enum class Kind { table, array, text, integer, number, boolean, date };
  Kind kind = Kind::table;
  SourcePosition at;
  std::string as_written;         ///< the first line of its source; empty for tables
  std::string text;               ///< Kind::text, unquoted
  double number = 0;              ///< Kind::number and Kind::integer
  std::int64_t integer = 0;       ///< Kind::integer
  bool boolean = false;           ///< Kind::boolean
  SharedList<TomlNode> items;     ///< Kind::array
  SharedList<TomlEntry> entries;  ///< Kind::table, in the order of the file

  /// The entry of that key; null if there is none.
  const TomlEntry* find(const std::string& key) const;
};

struct TomlEntry {
  std::string key;
  SourcePosition at;  ///< position of the key
  TomlNode value;
  bool is_set = false;  ///< not in the file: set by --set, --vary or a block of [[duty]]
};

/// "a table", "a text", "a whole number" ...
std::string describe(TomlNode::Kind kind);

class TomlSyntaxError : public std::runtime_error {
public:
  TomlSyntaxError(SourcePosition at, const std::string& message) : std::runtime_error(message), at_(at) {}
  SourcePosition at() const noexcept { return at_; }

private:
  SourcePosition at_;
};

/// @param text  a whole TOML 1.0 document, UTF-8
/// @throws TomlSyntaxError where the text is no TOML
TomlNode parse_toml(const std::string& text);

}  // namespace pipelines
