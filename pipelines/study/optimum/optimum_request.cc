#include "pipelines/study/optimum/optimum_request.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/base/names/units.h"

namespace pipelines {
namespace {

constexpr const char* bound_grammar =
    "write FIGURE >= VALUE UNIT or FIGURE <= VALUE UNIT, such as \"bodies.shaft.governing.safety >= 2\"";

std::string stripped(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// Those that people ask for: no errors, no single places, of a load its largest value.
std::string leading_names(const std::vector<std::string>& names) {
  std::string list;
  for (const auto& name : names) {
    const bool is_largest = name.size() > 4 && name.compare(name.size() - 4, 4, ".max") == 0;
    const bool is_detail = name.find(".error") != std::string::npos ||
                           name.find(".places.") != std::string::npos ||
                           (name.rfind("loads.", 0) == 0 && !is_largest);
    if (!is_detail) list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

/// A number without a unit is one of a figure without.
double number_alone(const std::string& quantity) {
  char* end = nullptr;
  const double number = std::strtod(quantity.c_str(), &end);
  if (end == quantity.c_str() || *end != '\0' || !std::isfinite(number))
    throw UnitError("the figure has no unit; write a number alone");
  return number;
}

}  // namespace

std::vector<std::string> OptimumRequest::figures() const {
  std::vector<std::string> names{goal};
  for (const auto& bound : bounds)
    if (!contains(names, bound.figure)) names.push_back(bound.figure);
  return names;
}

KeptBound parse_bound(const std::string& text) {
  const auto least = text.find(">="), most = text.find("<=");
  const auto at = std::min(least, most);
  KeptBound bound{text, stripped(text.substr(0, at)), least < most, ""};
  if (at != std::string::npos) bound.quantity = stripped(text.substr(at + 2));
  if (bound.figure.empty() || bound.quantity.empty() ||
      bound.quantity.find_first_of("<>=") != std::string::npos)
    throw OptionError("--keep " + text + ": is no bound; " + bound_grammar);
  return bound;
}

Variation parse_range(const std::string& text) {
  auto variation = parse_variation(text);
  if (!variation.range || !variation.values.empty())
    throw OptionError("--vary " + text + ": an optimum is searched in a range; write KEY = A..B UNIT");
  return variation;
}

void require_figure(const std::string& option, const std::string& figure, const SweepRow& row) {
  std::vector<std::string> known;
  for (const auto own : row.figures) known.push_back(own.name);
  if (contains(known, figure)) return;
  const auto nearest = nearest_name(figure, known);
  throw OptionError(
      option + ": a run of this scene has no figure \"" + figure + "\"; " +
      (nearest.empty() ? "it has " + leading_names(known) : "did you mean \"" + nearest + "\"?"));
}

std::string unit_of_figure(const SweepRow& row, const std::string& figure) {
  for (const auto own : row.figures)
    if (own.name == figure) return own.unit;
  return "";
}

double bound_in_si(const KeptBound& bound, const SweepRow& row) {
  require_figure("--keep " + bound.text, bound.figure, row);
  const auto unit = unit_of_figure(row, bound.figure);
  try {
    return unit.empty() ? number_alone(bound.quantity) : to_si(bound.quantity, unit);
  } catch (const UnitError& error) {
    throw OptionError("--keep " + bound.text + ": " + error.what());
  }
}

double stated_error(const SweepRow& row, const std::string& figure) {
  for (const char* error : {".error.total", ".error"})
    if (const double value = row.figure(figure + error); !std::isnan(value)) return value;
  const bool is_stress = figure.rfind("bodies.", 0) == 0 && unit_of_figure(row, figure) == "Pa";
  return is_stress ? std::numeric_limits<double>::infinity() : 0;
}

double assured(const SweepRow& row, const KeptBound& bound) {
  const double value = row.figure(bound.figure), error = stated_error(row, bound.figure);
  if (error == 0) return value;  // what endures is infinite
  return bound.is_least ? value - error : value + error;
}

double shortfall(const SweepRow& row, const KeptBound& bound, double bound_si) {
  constexpr double most = 3;
  const double value = assured(row, bound);
  if (std::isnan(value)) return most;
  const double excess = value > 0 && bound_si > 0
                            ? std::log(value / bound_si)
                            : (value - bound_si) / (bound_si == 0 ? 1 : std::abs(bound_si));
  return std::clamp(bound.is_least ? -excess : excess, -most, most);
}

}  // namespace pipelines
