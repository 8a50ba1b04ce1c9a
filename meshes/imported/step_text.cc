#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "meshes/imported/file_checks.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

const char* const write_step_again = "; export the part from the CAD again";

[[noreturn]] void refuse_step(int line, const std::string& what) {
  throw GeometryRefused("line " + std::to_string(line) + ": " + what + write_step_again);
}

constexpr std::string_view first_word = "ISO-10303-21", last_word = "END-ISO-10303-21",
                           byte_order_mark = "\xef\xbb\xbf";
constexpr std::array<std::string_view, 4> keywords = {first_word, "HEADER", "DATA", "ENDSEC"};

char upper(char c) {
  return char(std::toupper(static_cast<unsigned char>(c)));
}

/// Keywords are the same in small and capital letters, for readers if not by ISO 10303-21.
bool is_same_word(std::string_view text, std::string_view word) {
  return std::equal(text.begin(), text.end(), word.begin(), word.end(),
                    [](char a, char b) { return upper(a) == upper(b); });
}

std::string in_capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), upper);
  return text;
}

/// Goes through the text once, passing over strings and comments.
class StepText {
public:
  explicit StepText(const std::string& text) : text_(text) {}

  void check() {
    while (at_ < text_.size() && !has_ended_) step();
    if (!has_ended_ && in_statement_)
      refuse_step(statement_line_, "this statement does not end: the file is cut off");
    if (!has_ended_) refuse_step(line_, "there is no END-ISO-10303-21: the file is cut off");
    for (const auto& use : uses_)
      if (defined_.count(use.entity) == 0)
        refuse_step(use.line, "#" + std::to_string(use.by) + " refers to #" + std::to_string(use.entity) +
                                  ", which the file does not have: a line is missing or damaged");
  }

  /// The text without what stands between keywords and their semicolons.
  std::string without_gaps() const {
    std::string result;
    std::size_t from = 0;
    for (const auto& [begin, end] : gaps_) {
      result += text_.substr(from, begin - from);
      from = end;
    }
    return result += text_.substr(from);
  }

private:
  struct Use {
    long entity, by;
    int line;
  };

  void step() {
    const char c = text_[at_];
    if (ends_line(at_)) ++line_;
    if (std::isspace(static_cast<unsigned char>(c))) {
      ++at_;
    } else if (c == '\'') {
      begin();
      pass("'", "a text", 1);
    } else if (text_.compare(at_, 2, "/*") == 0) {
      pass("*/", "a comment", 2);
    } else if (c == '#' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1])) {
      number();
    } else if (c == ';') {
      end_statement();
      ++at_;
    } else {
      begin();
      word_end_ = ++at_;
    }
  }

  void end_statement() {
    if (in_statement_) {
      const auto statement = text_.substr(statement_at_, word_end_ - statement_at_);
      has_ended_ = is_same_word(statement, last_word);
      const bool is_keyword = has_ended_ || std::any_of(keywords.begin(), keywords.end(), [&](auto keyword) {
                                return is_same_word(statement, keyword);
                              });
      if (is_keyword && word_end_ < at_) gaps_.emplace_back(word_end_, at_);
    }
    in_statement_ = false;
  }

  /// Old Macs ended lines by a carriage return alone.
  bool ends_line(std::size_t at) const {
    return text_[at] == '\n' || (text_[at] == '\r' && text_.compare(at, 2, "\r\n") != 0);
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  void begin() {
    if (in_statement_) return;
    in_statement_ = true;
    statement_at_ = at_;
    statement_line_ = line_;
    word_end_ = at_;
    entity_ = 0;
  }

  void pass(const char* closing, const std::string& what, std::size_t n_opening) {
    const auto end = text_.find(closing, at_ + n_opening);
    if (end == std::string_view::npos) refuse_step(line_, what + " that begins here does not end");
    for (std::size_t i = at_; i < end; ++i) line_ += int(ends_line(i));
    at_ = end + n_opening;
    if (n_opening == 1) word_end_ = at_;  // a text
  }

  void number() {
    const bool first = !in_statement_;
    begin();
    constexpr long most = 1L << 40;
    long entity = 0;
    for (++at_; at_ < text_.size() && is_digit(text_[at_]); ++at_)
      entity = std::min(most, 10 * entity + (text_[at_] - '0'));
    word_end_ = at_;
    if (!first) {
      uses_.push_back({entity, entity_, line_});
      return;
    }
    entity_ = entity;
    if (const auto [other, is_new] = defined_.emplace(entity, line_); !is_new)
      refuse_step(line_, "#" + std::to_string(entity) + " is defined a second time, first in line " +
                             std::to_string(other->second));
  }

  std::string_view text_;
  std::size_t at_ = 0, statement_at_ = 0;
  std::size_t word_end_ = 0;  // behind the statement's last character that is no blank and no comment
  std::vector<std::pair<std::size_t, std::size_t>> gaps_;
  bool has_ended_ = false;  // what follows the last statement, as zeros and blanks of old disks, is no STEP
  int line_ = 1, statement_line_ = 1;
  bool in_statement_ = false;
  long entity_ = 0;  // entity that the statement defines
  std::unordered_map<long, int> defined_;
  std::vector<Use> uses_;
};

/// The statement of the unit that the file's points are in, in one line; empty: not stated. Base units of
/// conversions are length units too, so it is looked for by the number that global_unit_assigned_context of
/// ISO 10303-41 has.
std::string length_unit_of(const std::string& text) {
  constexpr std::string_view context = "GLOBAL_UNIT_ASSIGNED_CONTEXT";
  const auto at = text.find(context);
  if (at == std::string::npos) return {};
  const std::string units = text.substr(at, text.find(')', at) - at);
  for (auto begin = units.find('#'); begin != std::string::npos; begin = units.find('#', begin + 1)) {
    auto end = begin + 1;
    while (end < units.size() && std::isdigit(static_cast<unsigned char>(units[end]))) ++end;
    const std::string number = units.substr(begin, end - begin);
    for (auto found = text.find(number); found != std::string::npos; found = text.find(number, found + 1)) {
      auto after = found + number.size();
      while (after < text.size() && std::isspace(static_cast<unsigned char>(text[after]))) ++after;
      if (after >= text.size() || text[after] != '=') continue;
      std::string statement = text.substr(found, text.find(';', found) - found);
      std::replace_if(
          statement.begin(), statement.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
      if (statement.find("LENGTH_UNIT") != std::string::npos) return statement;
    }
  }
  return {};
}

bool is_millimetre(const std::string& statement) {
  return statement.find("CONVERSION_BASED_UNIT") == std::string::npos &&
         statement.find(".MILLI.") != std::string::npos;
}

}  // namespace

void check_step_text(const std::string& text) {
  step_text_to_read(text);
}

std::string step_text_to_read(std::string text) {
  if (text.compare(0, byte_order_mark.size(), byte_order_mark) == 0) text.erase(0, byte_order_mark.size());
  if (in_capitals(text).find(first_word) == std::string::npos)
    refuse_step(1, "this is no STEP file: it does not begin with ISO-10303-21");
  StepText whole(text);
  whole.check();
  return whole.without_gaps();
}

void check_step_unit(const std::string& text, double scale_to_m) {
  if (std::abs(scale_to_m / 1e-3 - 1) < 1e-12) return;
  const std::string statement = length_unit_of(in_capitals(text));
  if (statement.empty() || is_millimetre(statement)) return;
  throw GeometryRefused("it states its own length unit, " + statement +
                        ", and is read by it: length_unit would scale the part once more; leave it out, "
                        "or give \"1 mm\"");
}

}  // namespace meshes
