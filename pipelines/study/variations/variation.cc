#include "pipelines/study/variations/variation.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/csv.h"

namespace pipelines {
namespace {

constexpr long most_values = 1'000'000;
constexpr const char* grammar =
    "write KEY = 1200..1600 rpm / 9, KEY = 1..100 kN/m / 5 log, or KEY = 1200, 1400, 1600 rpm";

[[noreturn]] void refuse_variation(const std::string& text, const std::string& remedy) {
  throw OptionError("--vary " + text + ": " + remedy);
}

std::string without_blanks(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// The number that a text begins with, and what follows it; empty if it begins with none.
std::optional<std::pair<double, std::string>> leading_number(const std::string& text) {
  double number = 0;
  const bool has_plus = text.rfind('+', 0) == 0 && text.rfind("+-", 0) != 0;
  const char* const begin = text.data() + (has_plus ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
  return std::pair(number, without_blanks(std::string(end, text.data() + text.size())));
}

/// Splits at commas outside quotes and brackets.
std::vector<std::string> items_of(const std::string& text) {
  std::vector<std::string> items{""};
  int depth = 0;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == '\\' && quote == '"' && i + 1 < text.size())
        items.back() += text[i++];
      else if (c == quote)
        quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      items.emplace_back();
      continue;
    }
    items.back() += text[i];
  }
  for (auto& item : items) item = without_blanks(item);
  return items;
}

/// The text without brackets that enclose the whole; of a list of lists without the outer ones.
std::string without_brackets(const std::string& text) {
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') return text;
  int depth = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    depth += text[i] == '[' ? 1 : text[i] == ']' ? -1 : 0;
    if (depth == 0) return text;  // "[a], [b]": two lists
  }
  return without_blanks(text.substr(1, text.size() - 2));
}

/// A TOML text in quotes without them.
std::string without_quotes(const std::string& text) {
  const bool is_quoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'') &&
                         text.back() == text.front() && text.find(text.front(), 1) == text.size() - 1 &&
                         text.find('\\') == std::string::npos;
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

/// Numbers of one unit, as far as the values are that.
void find_numbers(Variation& variation) {
  std::vector<double> numbers;
  std::vector<std::string> units;
  for (const auto& value : variation.values) {
    const auto number = leading_number(without_quotes(value));
    if (!number) return;
    numbers.push_back(number->first);
    units.push_back(number->second);
  }
  const bool bare_but_last =
      std::all_of(units.begin(), units.end() - 1, [](const std::string& unit) { return unit.empty(); });
  const bool alike =
      std::all_of(units.begin(), units.end(), [&](const std::string& unit) { return unit == units.back(); });
  if (!bare_but_last && !alike) return;
  variation.unit = units.back();
  variation.numbers = numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) variation.values[i] = variation.text_of(numbers[i]);
}

/// How many values, behind the last slash; 0: the text does not say.
struct Count {
  long n = 0;
  bool is_logarithmic = false;
  std::string rest;  ///< what stands before it
};

Count count_of(const std::string& text) {
  Count none{0, false, text};
  const auto slash = text.rfind('/');
  if (slash == std::string::npos) return none;
  std::string behind = without_blanks(text.substr(slash + 1));
  Count count{0, false, without_blanks(text.substr(0, slash))};
  if (behind.size() > 3 && behind.compare(behind.size() - 3, 3, "log") == 0) {
    count.is_logarithmic = true;
    behind = without_blanks(behind.substr(0, behind.size() - 3));
  }
  const char* const last = behind.data() + behind.size();
  const auto [end, error] = std::from_chars(behind.data(), last, count.n);
  return error == std::errc() && end == last ? count : none;
}

}  // namespace

std::string Variation::text_of(double number) const {
  return shortest(number) + (unit.empty() ? "" : " " + unit);
}

std::vector<std::string> Variation::keys() const {
  return items_of(key);
}

std::string Variation::short_key() const {
  const auto all = keys();
  return all.size() < 2 ? key : all.front() + " and " + std::to_string(all.size() - 1) + " more";
}

Variation parse_variation(const std::string& text) {
  const auto equals = text.find('=');
  Variation variation;
  variation.key = without_blanks(text.substr(0, equals));
  const std::string values = equals == std::string::npos ? "" : without_blanks(text.substr(equals + 1));
  const auto keys = variation.keys();
  const bool lacks_a_key = std::any_of(keys.begin(), keys.end(), [](const auto& k) { return k.empty(); });
  if (lacks_a_key || values.empty()) refuse_variation(text, std::string("is no variation; ") + grammar);
  const auto dots = values.find("..");
  const bool is_range = dots != std::string::npos && values.find_first_of("\"'[{,") == std::string::npos;
  if (!is_range) {
    for (auto& item : items_of(without_brackets(values))) {
      if (item.empty()) refuse_variation(text, std::string("has an empty value; ") + grammar);
      variation.values.push_back(std::move(item));
    }
    find_numbers(variation);
    return variation;
  }
  const Count count = count_of(values);
  const auto first = leading_number(without_blanks(count.rest.substr(0, dots)));
  const auto last = leading_number(without_blanks(count.rest.substr(dots + 2)));
  if (!first || !last) refuse_variation(text, std::string("is no range of numbers; ") + grammar);
  if (!first->second.empty() && first->second != last->second)
    refuse_variation(text, "has two units; write both ends in one, behind the second");
  variation.unit = last->second;
  const ValueRange range{first->first, last->first, count.is_logarithmic};
  if (range.is_logarithmic && !(range.first > 0 && range.last > 0))
    refuse_variation(text, "needs two positive ends for equal ratios");
  if (range.first == range.last)
    refuse_variation(text, "begins where it ends; write one value, or another end");
  variation.range = range;
  if (count.n == 0 && count.rest == values) return variation;
  if (count.n < 2 || count.n > most_values)
    refuse_variation(text, "needs 2 to " + std::to_string(most_values) + " values behind the slash");
  for (long i = 0; i < count.n; ++i) {
    const double share = double(i) / double(count.n - 1);
    const double number = i + 1 == count.n       ? range.last
                          : range.is_logarithmic ? range.first * std::pow(range.last / range.first, share)
                                                 : range.first + share * (range.last - range.first);
    variation.numbers.push_back(number);
    variation.values.push_back(variation.text_of(number));
  }
  return variation;
}

}  // namespace pipelines
