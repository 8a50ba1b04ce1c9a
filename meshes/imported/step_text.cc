#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "meshes/imported/file_checks.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

const char* const write_step_again = "; export the part from the CAD again";

[[noreturn]] void refuse_step(int line, const std::string& what) {
  throw GeometryRefused("line " + std::to_string(line) + ": " + what + write_step_again);
}

constexpr std::string_view first_word = "ISO-10303-21", last_word = "END-ISO-10303-21";

char upper(char c) {
  return char(std::toupper(static_cast<unsigned char>(c)));
}

/// Keywords are the same in small and capital letters, for readers if not by ISO 10303-21. Blanks at the end
/// do not count.
bool is_same_word(std::string_view text, std::string_view word) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
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
      has_ended_ = in_statement_ && is_same_word(text_.substr(statement_at_, at_ - statement_at_), last_word);
      in_statement_ = false;
      ++at_;
    } else {
      begin();
      ++at_;
    }
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
    entity_ = 0;
  }

  void pass(const char* closing, const std::string& what, std::size_t n_opening) {
    const auto end = text_.find(closing, at_ + n_opening);
    if (end == std::string_view::npos) refuse_step(line_, what + " that begins here does not end");
    for (std::size_t i = at_; i < end; ++i) line_ += int(ends_line(i));
    at_ = end + n_opening;
  }

  void number() {
    const bool first = !in_statement_;
    begin();
    constexpr long most = 1L << 40;
    long entity = 0;
    for (++at_; at_ < text_.size() && is_digit(text_[at_]); ++at_)
      entity = std::min(most, 10 * entity + (text_[at_] - '0'));
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
  if (in_capitals(text).find(first_word) == std::string::npos)
    refuse_step(1, "this is no STEP file: it does not begin with ISO-10303-21");
  StepText(text).check();
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
