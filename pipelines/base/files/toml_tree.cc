#include "pipelines/base/files/toml_tree.h"

// The parser is in libtomlplusplus; this is the one file that sees the templates of its header.
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

#include "meshes/values/utf8.h"
#include "pipelines/base/names/odd_characters.h"

namespace pipelines {
namespace {

SourcePosition to_position(const toml::source_position& p) {
  return {static_cast<int>(p.line), static_cast<int>(p.column)};
}

/// Lines of the text, for cutting out values as they were written.
class SourceLines {
public:
  explicit SourceLines(std::string_view text) {
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      lines_.push_back(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  /// Text from `begin` to `end`, cut at the end of the first line.
  std::string cut(const toml::source_region& region) const {
    if (region.begin.line < 1 || region.begin.line > lines_.size()) return {};
    std::string_view line = lines_[region.begin.line - 1];
    const bool goes_on = region.end.line > region.begin.line;
    const std::size_t begin = byte_of(line, region.begin.column);
    const std::size_t end = goes_on ? line.size() : byte_of(line, region.end.column);
    std::string text(line.substr(begin, std::min(longest_cut, end - begin)));
    if (end - begin > longest_cut) return text + " ...";
    while (!text.empty() && (text.back() == '\r' || text.back() == ' ')) text.pop_back();
    return goes_on ? text + " ..." : text;
  }

private:
  static constexpr std::size_t longest_cut = 4000;

  /// Offset of the 1-based column, counted in UTF-8 characters. It goes on from the last place asked for,
  /// forwards or back: values of a line lie beside each other, and there may be 100 000 of them.
  std::size_t byte_of(std::string_view line, std::size_t column) const {
    column = std::max<std::size_t>(1, column);
    if (last_.line != line.data()) last_ = {line.data(), 1, 0};
    std::size_t &at = last_.column, &byte = last_.byte;
    const auto inside = [&] { return (static_cast<unsigned char>(line[byte]) & 0xC0) == 0x80; };
    for (; at > column; --at) do
        --byte;
      while (inside());
    for (; at < column && byte < line.size(); ++at) do
        ++byte;
      while (byte < line.size() && inside());
    return byte;
  }

  struct Place {
    const char* line = nullptr;
    std::size_t column = 1, byte = 0;
  };

  std::vector<std::string_view> lines_;
  mutable Place last_;
};

constexpr int most_parts_of_a_name = 100;

/// The parser follows a name such as a.b.c by recursion, part by part, and a page of them overflows the
/// stack. Looks at texts and comments, too: they have no such words.
void refuse_endless_names(const std::string& text) {
  SourcePosition at{1, 1};
  int n_parts = 0;
  bool after_dot = false, after_part = false;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '.' && after_part) {
      after_dot = true;
      after_part = false;
    } else if (std::isalnum(byte) != 0 || c == '_' || c == '-' || c == '"' || c == '\'') {
      if (!after_part) n_parts = after_dot ? n_parts + 1 : 1;
      after_part = true;
      after_dot = false;
    } else if (c != ' ' && c != '\t') {
      after_dot = after_part = false;
    }
    if (n_parts > most_parts_of_a_name)
      throw TomlSyntaxError(at, "a name has more than " + std::to_string(most_parts_of_a_name) + " parts");
    if (c == '\n') at = {at.line + 1, 0};
    if ((byte & 0xC0) != 0x80) ++at.column;
  }
}

SourcePosition position_of(std::string_view text, std::size_t byte) {
  SourcePosition at{1, 1};
  for (const char c : text.substr(0, byte)) {
    if (c == '\n') at = {at.line + 1, 0};
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) ++at.column;
  }
  return at;
}

/// Length of the comment or of the text in quotes that begins here; 1 for anything else. A text that is not
/// closed has length 1 too: what keeps it open may stand in it.
std::size_t length_of_free_text(std::string_view rest) {
  if (rest[0] == '#') return std::min(rest.find('\n'), rest.size());
  if (rest[0] != '"' && rest[0] != '\'') return 1;
  const std::string three(3, rest[0]);
  if (rest.substr(0, 3) == three) {
    const auto end = rest.find(three, 3);
    return end == std::string_view::npos ? 1 : end + 3;
  }
  for (std::size_t i = 1; i < rest.size() && rest[i] != '\n'; ++i) {
    if (rest[i] == '\\' && rest[0] == '"')
      ++i;
    else if (rest[i] == rest[0])
      return i + 1;
  }
  return 1;
}

/// The first character outside texts and comments that looks like one of a keyboard and is another.
/// @param text  that is no TOML
std::optional<OddCharacter> odd_character_outside_texts(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = length_of_free_text(text.substr(i));
    const auto next = length > 1 ? std::nullopt : odd_character_in(text.substr(i, 3));
    const bool is_byte_order_mark = i == 0 && text[0] == '\xEF';
    if (next && next->byte == 0 && !is_byte_order_mark) return OddCharacter{i, next->name, next->remedy};
    i += length;
  }
  return std::nullopt;
}

std::string hexadecimal(unsigned char byte) {
  constexpr const char* digits = "0123456789ABCDEF";
  return std::string("0x") + digits[byte / 16] + digits[byte % 16];
}

std::size_t first_byte_that_is_no_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    if (!meshes::is_utf8(text.substr(i, length))) return i;
    i += length;
  }
  return text.size();
}

/// Why a text is no TOML, better than the parser knows it; falls back on what that says.
TomlSyntaxError syntax_error(std::string_view text, const toml::parse_error& error) {
  if (!meshes::is_utf8(text)) {
    const std::size_t good = first_byte_that_is_no_utf8(text);
    return TomlSyntaxError(position_of(text, good),
                           "the byte " + hexadecimal(static_cast<unsigned char>(text[good])) +
                               " is no UTF-8, perhaps Windows-1252 (Latin-1); save the file as UTF-8");
  }
  if (const auto odd = odd_character_outside_texts(text))
    return TomlSyntaxError(position_of(text, odd->byte),
                           odd->name + " stands outside texts in quotes; " + odd->remedy);
  return TomlSyntaxError(to_position(error.source().begin), std::string(error.description()));
}

TomlNode convert(const toml::node& node, const SourceLines& lines) {
  TomlNode result;
  result.at = to_position(node.source().begin);
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      result.entries.push_back(
          {std::string(key.str()), to_position(key.source().begin), convert(value, lines)});
    auto& entries = result.entries.own();
    std::sort(entries.begin(), entries.end(), [](const TomlEntry& a, const TomlEntry& b) {
      return std::pair(a.at.line, a.at.column) < std::pair(b.at.line, b.at.column);
    });
    return result;
  }
  result.as_written = lines.cut(node.source());
  if (const auto* array = node.as_array()) {
    result.kind = TomlNode::Kind::array;
    for (const auto& item : *array) result.items.push_back(convert(item, lines));
  } else if (const auto* text = node.as_string()) {
    result.kind = TomlNode::Kind::text;
    result.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    result.kind = TomlNode::Kind::integer;
    result.integer = integer->get();
    result.number = static_cast<double>(result.integer);
  } else if (const auto* number = node.as_floating_point()) {
    result.kind = TomlNode::Kind::number;
    result.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    result.kind = TomlNode::Kind::boolean;
    result.boolean = boolean->get();
  } else {
    result.kind = TomlNode::Kind::date;
  }
  return result;
}

}  // namespace

const TomlEntry* TomlNode::find(const std::string& key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const TomlEntry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

std::string describe(TomlNode::Kind kind) {
  switch (kind) {
    case TomlNode::Kind::table:
      return "a table";
    case TomlNode::Kind::array:
      return "an array";
    case TomlNode::Kind::text:
      return "a text";
    case TomlNode::Kind::integer:
      return "a whole number";
    case TomlNode::Kind::number:
      return "a number";
    case TomlNode::Kind::boolean:
      return "true or false";
    case TomlNode::Kind::date:
      return "a date or time";
  }
  return "a value";
}

TomlNode parse_toml(const std::string& text) {
  refuse_endless_names(text);
  try {
    const toml::table table = toml::parse(std::string_view(text));
    return convert(table, SourceLines(text));
  } catch (const toml::parse_error& error) {
    throw syntax_error(text, error);
  }
}

}  // namespace pipelines
