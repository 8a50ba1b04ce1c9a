#include "tests/fuzz/mutator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "tests/fuzz/tokens.h"

namespace fuzz {
namespace {

using namespace std::string_literals;

/// At the ends of what double, 32 and 64 bits hold, and what is hardly a number.
const std::vector<std::string> odd_numbers = {"0",
                                              "-0.0",
                                              "-1",
                                              "1e308",
                                              "-1e308",
                                              "1e-300",
                                              "1e-320",
                                              "5e-324",
                                              "nan",
                                              "-nan",
                                              "inf",
                                              "-inf",
                                              "2147483647",
                                              "2147483648",
                                              "-2147483649",
                                              "4294967296",
                                              "9223372036854775807",
                                              "9223372036854775808",
                                              "99999999999999999999",
                                              "1e999",
                                              "1e-999",
                                              "0x7fffffff",
                                              "1e4",
                                              "1e9",
                                              "100000",
                                              "0.1",
                                              "1_000",
                                              "1,5",
                                              "1e",
                                              "--1",
                                              "+-1",
                                              "\xD9\xA3",
                                              "1/0",
                                              "1.",
                                              ".5",
                                              "007",
                                              "9"};

/// Quotes, brackets, other encodings, other types, paths, and what ends things early.
const std::vector<std::string> odd_pieces = {"\"",
                                             "'",
                                             "[",
                                             "]",
                                             "[[",
                                             "]]",
                                             "{",
                                             "}",
                                             "(",
                                             ")",
                                             "=",
                                             "= [",
                                             ",",
                                             ";",
                                             ":",
                                             "#",
                                             "-",
                                             ".",
                                             "\\",
                                             "\\u0000",
                                             "\\uD800",
                                             "\\U0010FFFF",
                                             "\"\"\"",
                                             "''",
                                             "\t",
                                             "\r",
                                             "\n",
                                             "\r\n",
                                             "\0"s,
                                             "\xC3\x28",
                                             "\xFF",
                                             "\xEF\xBB\xBF",
                                             "\xE2\x80\xAE",
                                             "\xC2\xB0",
                                             "\xC2\xB5",
                                             "true",
                                             "null",
                                             "nan",
                                             "1979-05-27",
                                             "../../",
                                             "/dev/zero",
                                             "%s%n",
                                             "$End",
                                             "$Nodes\n",
                                             "/*",
                                             "*/",
                                             "mm",
                                             "rpm",
                                             "Hz",
                                             "km/h",
                                             "^99999",
                                             "^-2147483648",
                                             "@",
                                             "=1+1",
                                             "<script>",
                                             "machine",
                                             "fillet",
                                             "port = \"",
                                             "1e-320 "};

struct Draw {
  Mutator& random;
  Grammar grammar;
  const std::string& other;

  std::size_t below(std::size_t n) const { return random.below(n); }
  /// Small more often than large.
  std::size_t size_up_to(std::size_t most) const {
    return std::min(most, std::size_t(std::pow(double(most), random.share())));
  }
  char comment() const { return grammar == Grammar::toml || grammar == Grammar::csv ? '#' : '\0'; }
  Span number(const std::string& text) const { return one_of(numbers_of(text, comment())); }
  Span one_of(const std::vector<Span>& spans) const { return spans.empty() ? Span{} : random.one_of(spans); }
};

void replace(std::string& text, Span span, const std::string& by) {
  text.replace(span.begin, span.length, by);
}

// ---- Numbers ----

/// By a factor of up to 1e3 either way, by a tenth, to zero, or to the other sign: most files stay valid.
void change_number(std::string& text, const Draw& draw) {
  const auto span = draw.number(text);
  const double value = std::strtod(text.c_str() + span.begin, nullptr);
  const double factor = std::pow(10, 6 * draw.random.share() - 3);
  const std::array<double, 6> changed = {value * factor, value * factor, value * 1.1, value * 0.9, 0, -value};
  char number[40];
  std::snprintf(number, sizeof number, "%.6g", draw.random.one_of(changed));
  replace(text, span, number);
}

void make_number_odd(std::string& text, const Draw& draw) {
  replace(text, draw.number(text), draw.random.one_of(odd_numbers));
}

void draw_digits(std::string& text, const Draw& draw) {
  const auto span = draw.number(text);
  for (auto i = span.begin; i < span.begin + span.length; ++i)
    if (text[i] >= '0' && text[i] <= '9') text[i] = char('0' + draw.below(10));
}

/// Eight bytes that are an infinity, no number, or a count beyond all files.
void overwrite_number(std::string& text, const Draw& draw) {
  static const std::array<std::uint64_t, 6> values = {
      0x7ff0000000000000, 0x7ff8000000000000, 0x7fefffffffffffff, 0xffffffffffffffff, 0x7fffffff, 1ULL << 63};
  const auto value = draw.random.one_of(values);
  const auto at = draw.below(text.size()) & ~std::size_t(7);
  std::memcpy(&text[at], &value, std::min(sizeof value, text.size() - at));
}

void change_reference(std::string& text, const Draw& draw) {
  const auto references = references_of(text);
  replace(text, draw.one_of(references), "#" + std::to_string(1 + draw.below(2 * references.size())));
}

// ---- Words and characters ----

/// Two of them, drawn.
void swap_of(const std::vector<Span>& spans, std::string& text, const Draw& draw) {
  auto a = draw.one_of(spans), b = draw.one_of(spans);
  if (a.begin > b.begin) std::swap(a, b);
  if (a.begin == b.begin) return;
  const auto first = text.substr(a.begin, a.length);
  const auto second = text.substr(b.begin, b.length);
  replace(text, b, first);
  replace(text, a, second);
}

void swap_words(std::string& text, const Draw& draw) {
  swap_of(words_of(text), text, draw);
}

void insert_piece(std::string& text, const Draw& draw) {
  text.insert(draw.below(text.size() + 1), draw.random.one_of(odd_pieces));
}

void erase_characters(std::string& text, const Draw& draw) {
  text.erase(draw.below(text.size()), 1 + draw.below(8));
}

void insert_long_text(std::string& text, const Draw& draw) {
  static const std::vector<std::string> parts = {"a", "9", " ", "\n", ",", "0,", "ab ", "\xC3\xA9"};
  const auto& part = draw.random.one_of(parts);
  std::string inserted;
  for (auto n = draw.size_up_to(300'000); n > 0; --n) inserted += part;
  text.insert(draw.below(text.size() + 1), inserted);
}

/// Brackets within brackets, closed or not.
void nest(std::string& text, const Draw& draw) {
  static const std::vector<std::pair<std::string, std::string>> brackets = {
      {"[", "]"}, {"{\"a\":", "}"}, {"(", ")"}, {"{ a = ", " }"}, {"[[", "]]"}, {"a.", ""}};
  const auto& [open, close] = draw.random.one_of(brackets);
  const bool closed = draw.below(3) > 0;
  std::string front, back;
  for (auto n = draw.size_up_to(100'000); n > 0; --n) {
    front += open;
    if (closed) back += close;
  }
  const auto inserted = front + (closed ? "1" : "") + back;
  const auto number = draw.number(text);
  if (draw.below(2) == 0 && number.length > 0) return replace(text, number, inserted);
  text.insert(draw.below(text.size() + 1), inserted);
}

// ---- Lines ----

void remove_line(std::string& text, const Draw& draw) {
  replace(text, draw.one_of(lines_of(text)), "");
}

/// Beside itself or elsewhere, once or many times.
void repeat_line(std::string& text, const Draw& draw) {
  const auto lines = lines_of(text);
  const auto line = draw.one_of(lines);
  const auto written = text.substr(line.begin, line.length);
  const auto at = draw.below(2) == 0 ? line.begin : draw.one_of(lines).begin;
  std::string inserted;
  for (auto n = draw.below(4) > 0 ? 1 : draw.size_up_to(2000); n > 0; --n) inserted += written;
  text.insert(at, inserted);
}

void swap_lines(std::string& text, const Draw& draw) {
  swap_of(lines_of(text), text, draw);
}

void change_line_ends(std::string& text, const Draw& draw) {
  static const std::vector<std::string> ends = {"\r\n", "\r", "", "\n\n", "\n\r"};
  const auto& end = draw.random.one_of(ends);
  std::string changed;
  for (const char c : text) c == '\n' ? void(changed += end) : changed.push_back(c);
  text = changed;
}

// ---- Bytes and blocks ----

void flip_bit(std::string& text, const Draw& draw) {
  text[draw.below(text.size())] ^= char(1 << draw.below(8));
}

void draw_byte(std::string& text, const Draw& draw) {
  text[draw.below(text.size())] = char(draw.below(256));
}

Span block_of(const std::string& text, const Draw& draw) {
  const auto begin = draw.below(text.size());
  return {begin, std::min(text.size() - begin, 1 + draw.size_up_to(4096))};
}

void blank_block(std::string& text, const Draw& draw) {
  const auto block = block_of(text, draw);
  replace(text, block, std::string(block.length, draw.below(2) == 0 ? '\0' : '\xFF'));
}

void remove_block(std::string& text, const Draw& draw) {
  replace(text, block_of(text, draw), "");
}

void copy_block(std::string& text, const Draw& draw) {
  const auto from = block_of(text, draw);
  const auto block = text.substr(from.begin, from.length);
  const Span to{draw.below(text.size()), draw.below(2) == 0 ? from.length : 0};
  replace(text, to, block);
}

void cut_off(std::string& text, const Draw& draw) {
  text.resize(draw.below(text.size()));
}

void append_bytes(std::string& text, const Draw& draw) {
  for (auto n = 1 + draw.size_up_to(2000); n > 0; --n) text += char(draw.below(256));
}

/// The beginning of one file and the end of another.
void splice(std::string& text, const Draw& draw) {
  const auto end_of_first = draw.one_of(lines_of(text)).begin;
  const auto begin_of_second = draw.one_of(lines_of(draw.other)).begin;
  text = text.substr(0, end_of_first) + draw.other.substr(begin_of_second);
}

struct Damage {
  const char* name;
  void (*apply)(std::string&, const Draw&);
};

constexpr Damage number_changed = {"number changed", change_number};
constexpr Damage number_odd = {"odd number", make_number_odd};
constexpr Damage number_overwritten = {"number overwritten", overwrite_number};
constexpr Damage reference_changed = {"reference changed", change_reference};

const std::vector<Damage> to_any_text = {{"digits drawn", draw_digits},
                                         {"words swapped", swap_words},
                                         {"piece inserted", insert_piece},
                                         {"characters missing", erase_characters},
                                         {"long text inserted", insert_long_text},
                                         {"nested", nest},
                                         {"line missing", remove_line},
                                         {"line repeated", repeat_line},
                                         {"lines swapped", swap_lines},
                                         {"line ends changed", change_line_ends},
                                         {"spliced", splice}};

const std::vector<Damage> to_bytes = {{"bit flipped", flip_bit},     {"byte drawn", draw_byte},
                                      {"block blank", blank_block},  {"block missing", remove_block},
                                      {"block copied", copy_block},  {"cut off", cut_off},
                                      {"bytes behind", append_bytes}};

Damage drawn_damage(const Draw& draw) {
  const auto pick = draw.below(100);
  // How often numbers are damaged, of 100, how often made odd, and how often references are.
  struct Shares {
    std::size_t changed, odd, references, text;
  };
  const auto shares = [&]() -> Shares {
    switch (draw.grammar) {
      case Grammar::toml:
      case Grammar::csv:
        return {60, 15, 0, 16};
      case Grammar::json:
        return {10, 20, 0, 50};
      case Grammar::msh:
        return {15, 25, 0, 40};
      case Grammar::step:
        return {15, 15, 25, 30};
      default:
        return {0, 0, 0, 0};
    }
  }();
  if (pick < shares.changed) return number_changed;
  if (pick < shares.changed + shares.odd) return number_odd;
  if (pick < shares.changed + shares.odd + shares.references) return reference_changed;
  if (pick < shares.changed + shares.odd + shares.references + shares.text)
    return draw.random.one_of(to_any_text);
  if (draw.grammar == Grammar::bytes && pick >= 80) return number_overwritten;
  return draw.random.one_of(to_bytes);
}

}  // namespace

std::string Mutator::damage(std::string text, Grammar grammar, const std::string& other) {
  std::size_t n = 1;
  while (n < 6 && one_in(3)) ++n;
  const Draw draw{*this, grammar, other};
  for (; n > 0 && !text.empty(); --n) {
    const auto damage = drawn_damage(draw);
    damage.apply(text, draw);
    deeds_ += (deeds_.empty() ? "" : ", ") + std::string(damage.name);
  }
  return text;
}

}  // namespace fuzz
