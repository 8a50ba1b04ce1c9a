#include "pipelines/scene/tables/table_cells.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "pipelines/base/names/odd_characters.h"
#include "pipelines/scene/tables/table_title.h"

namespace pipelines {
namespace {

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

std::vector<Cell> cells_between_blanks(std::string_view line, std::size_t least_blanks) {
  std::vector<Cell> cells;
  bool quoted = false;
  std::size_t n_blanks = least_blanks;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_blank = line[i] == ' ' || line[i] == '\t' || line[i] == '\r';
    if (is_blank && !quoted) {
      ++n_blanks;
      continue;
    }
    if (n_blanks >= least_blanks)
      cells.push_back({"", int(i) + 1});
    else if (n_blanks > 0)
      cells.back().text += ' ';
    n_blanks = 0;
    if (line[i] == '"')
      quoted = !quoted;
    else
      cells.back().text += line[i];
  }
  return cells;
}

struct FromChars {
  double value = 0;
  bool is_whole = false;  ///< all of the text was read
  bool is_finite = false;
};

FromChars from_text(const std::string& text) {
  FromChars read;
  const char* const begin = text.c_str() + (text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char* const end = text.c_str() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, read.value);
  read.is_whole = error != std::errc::invalid_argument && stop == end;
  read.is_finite = error == std::errc() && std::isfinite(read.value);
  return read;
}

/// "1,234" and "-12,345e3", not "0,123" and "1,23": no thousands begin with 0.
bool may_be_thousands(const std::string& text, std::size_t comma) {
  std::size_t begin = text[0] == '+' || text[0] == '-' ? 1 : 0;
  const std::size_t n_before = comma - begin;
  std::size_t n_behind = 0;
  while (comma + 1 + n_behind < text.size() && is_digit(text[comma + 1 + n_behind])) ++n_behind;
  return n_before >= 1 && n_before <= 3 && text[begin] != '0' && n_behind == 3;
}

/// Groups of three digits with one character between them: "1.234.567", "1 234", "12'345,6".
bool has_thousands(const std::string& text) {
  std::string plain;  // blanks of any width and apostrophes as one character
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::size_t length = 0;
    for (const std::string_view separator :
         {" ", "'", "\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89", "\xE2\x80\x99"})
      if (std::string_view(text).substr(i, separator.size()) == separator) length = separator.size();
    plain += length > 0 ? '\'' : text[i];
    i += length > 0 ? length - 1 : 0;
  }
  const bool is_of_digits = plain.find_first_not_of("+-0123456789.,'eE") == std::string::npos;
  const auto n = [&](char c) { return std::count(plain.begin(), plain.end(), c); };
  return is_of_digits && is_digit(plain.back()) &&
         (n('\'') > 0 || n(',') > 1 || n('.') > 1 || (n(',') == 1 && n('.') == 1));
}

CellNumber::Kind kind_of_fault(const std::string& text, char decimal) {
  using Kind = CellNumber::Kind;
  if (text.empty()) return Kind::empty;
  if (has_thousands(text)) return Kind::thousands;
  if (decimal == '.' && std::count(text.begin(), text.end(), ',') == 1) {
    auto with_point = text;
    with_point[text.find(',')] = '.';
    if (from_text(with_point).is_whole) return Kind::other_comma;
  }
  if (text.find(':') != std::string::npos && is_digit(text.front())) return Kind::time_of_day;
  return odd_character_in(text) ? Kind::odd_character : Kind::no_number;
}

}  // namespace

std::vector<Cell> cells_of(std::string_view line, char delimiter) {
  if (delimiter == runs_of_blanks) return cells_between_blanks(line, 1);
  std::vector<Cell> cells{{"", 1}};
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back().text += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == delimiter && !quoted)
      cells.push_back({"", int(i) + 2});
    else
      cells.back().text += line[i];
  }
  for (auto& cell : cells) cell.text = without_blanks(cell.text);
  return cells;
}

std::vector<Cell> titles_between_blanks(std::string_view line, std::size_t n_wanted) {
  auto titles = cells_between_blanks(line, 2);
  if (titles.size() == n_wanted) return titles;
  titles.clear();
  for (auto& word : cells_between_blanks(line, 1)) {
    const bool is_open = !titles.empty() && titles.back().text.find('[') != std::string::npos &&
                         titles.back().text.find(']') == std::string::npos;
    const bool belongs_to_last = !titles.empty() && (is_open || word.text[0] == '[' || word.text[0] == '(');
    if (belongs_to_last)
      titles.back().text += " " + word.text;
    else
      titles.push_back(std::move(word));
  }
  return titles;
}

CellNumber number_of(const std::string& cell, char decimal) {
  using Kind = CellNumber::Kind;
  const auto comma = cell.find(',');
  if (decimal != ',' || comma == std::string::npos) {
    const auto read = from_text(cell);
    const bool has_point = cell.find('.') != std::string::npos;
    if (read.is_whole && decimal == ',' && has_point) return {Kind::other_point};
    if (read.is_whole && !read.is_finite) return {Kind::not_finite};
    if (read.is_whole) return {has_point ? Kind::with_point : Kind::whole, read.value};
  }
  if (decimal == '.' || comma == std::string::npos ||
      cell.find_first_of(".,", comma + 1) != std::string::npos || cell.find('.') < comma)
    return {kind_of_fault(cell, decimal)};
  std::string with_point = cell;
  with_point[comma] = '.';
  const auto read = from_text(with_point);
  if (!read.is_whole) return {kind_of_fault(cell, decimal)};
  if (!read.is_finite) return {Kind::not_finite};
  return {decimal != ',' && may_be_thousands(cell, comma) ? Kind::comma_in_doubt : Kind::with_comma,
          read.value};
}

}  // namespace pipelines
