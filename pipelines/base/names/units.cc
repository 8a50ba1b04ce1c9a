#include "pipelines/base/names/units.h"

#include <udunits2.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/odd_characters.h"

namespace pipelines {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

/// The database that the library knows, or one of the usual places if its own path or UDUNITS2_XML_PATH is
/// stale.
ut_system* read_database() {
  ut_set_error_message_handler(ut_ignore);
  const char* const paths[] = {nullptr, "/usr/share/xml/udunits/udunits2.xml",
                               "/usr/share/udunits/udunits2.xml", "/usr/local/share/udunits/udunits2.xml"};
  for (const char* path : paths) {
    ut_system* const system = ut_read_xml(path);
    if (system == nullptr) continue;
    // Everyday symbols that udunits lacks; an existing meaning is left alone.
    for (const auto& [symbol, name] : {std::pair{"deg", "arc_degree"}, std::pair{"rev", "turn"}})
      if (const Unit unit(ut_get_unit_by_name(system, name)); unit)
        ut_map_symbol_to_unit(symbol, UT_ASCII, unit.get());
    for (const auto& [symbol, product] : {std::pair{"Nm", "N m"}, std::pair{"Nmm", "N mm"}})
      if (const Unit unit(ut_parse(system, product, UT_ASCII));
          unit && !Unit(ut_get_unit_by_symbol(system, symbol)))
        ut_map_symbol_to_unit(symbol, UT_ASCII, unit.get());
    return system;
  }
  throw FileError(
      "the unit database udunits2.xml is not found: install the package libudunits2-data, or set "
      "UDUNITS2_XML_PATH to the file");
}

/// Lives as long as the process: udunits keeps pointers into it.
ut_system* unit_system() {
  static ut_system* const system = read_database();
  return system;
}

/// Powers of the base units, the radian included: {"kg": 1, "s": -2} ...
using Dimension = std::map<std::string, int>;

extern "C" {
ut_status visit_basic(const ut_unit* unit, void* dimension) {
  const char* const symbol = ut_get_symbol(unit, UT_ASCII);
  (*static_cast<Dimension*>(dimension))[symbol ? symbol : "?"] += 1;
  return UT_SUCCESS;
}

ut_status visit_product(const ut_unit*, int count, const ut_unit* const* units, const int* powers,
                        void* dimension) {
  for (int i = 0; i < count; ++i) {
    const char* const symbol = ut_get_symbol(units[i], UT_ASCII);
    (*static_cast<Dimension*>(dimension))[symbol ? symbol : "?"] += powers[i];
  }
  return UT_SUCCESS;
}

ut_status visit_galilean(const ut_unit*, double, const ut_unit* underlying, double, void* dimension);

ut_status visit_timestamp(const ut_unit*, const ut_unit*, double, void*) {
  return UT_MEANINGLESS;
}

ut_status visit_logarithmic(const ut_unit*, double, const ut_unit*, void*) {
  return UT_MEANINGLESS;
}
}

const ut_visitor dimension_visitor = {visit_basic, visit_product, visit_galilean, visit_timestamp,
                                      visit_logarithmic};

ut_status visit_galilean(const ut_unit*, double, const ut_unit* underlying, double, void* dimension) {
  return ut_accept_visitor(underlying, &dimension_visitor, dimension);
}

/// @return empty text for a pure number; "log" where a scale has no dimension in our sense (dates, decibels)
Dimension dimension_of(const ut_unit* unit) {
  Dimension dimension;
  if (ut_accept_visitor(unit, &dimension_visitor, &dimension) != UT_SUCCESS) return {{"log", 1}};
  return dimension;
}

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) >= 0x80;
}

/// udunits lets numbers and half-read text pass inside a unit ("mm)", "3 mm", "mm 10"): only exponents are
/// digits here, and parentheses come in pairs. A leading "1/" stays.
bool is_well_formed(std::string_view unit) {
  if (unit.substr(0, 2) == "1/") unit.remove_prefix(2);
  int depth = 0;
  char before = ' ';
  for (const char c : unit) {
    if (std::isdigit(static_cast<unsigned char>(c)) && !is_letter(before) &&
        std::strchr("^-+0123456789)", before) == nullptr)
      return false;
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (depth < 0) return false;
    before = c;
  }
  return depth == 0;
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string example(const std::string& si_unit) {
  static const std::map<std::string, std::string> examples = {
      {"m", "\"30 mm\""},          {"kg", "\"30 kg\""},
      {"rad", "\"40 deg\""},       {"rad/s", "\"1450 rpm\", \"24.2 Hz\" or \"151.8 rad/s\""},
      {"N", "\"5.1 kN\""},         {"N/m", "\"27.5 kN/m\""},
      {"N s/m", "\"60 N s/m\""},   {"Pa", "\"206 GPa\""},
      {"W", "\"500 W\""},          {"kg/m3", "\"7.85 t/m3\""},
      {"kg m2", "\"2.85 kg m2\""}, {"m/s2", "\"9.81 m/s2\""},
      {"1", "\"50 %\" or 0.5"}};
  const auto found = examples.find(si_unit);
  return found != examples.end() ? found->second : "\"1 " + si_unit + "\"";
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

struct NumberAndRest {
  double number;
  std::string rest;
};

NumberAndRest split(const std::string& quantity, const std::string& si_unit) {
  std::string_view text = trimmed(quantity);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::invalid_argument) {
    if (const auto odd = odd_character_in(text); odd && odd->byte == 0)
      throw UnitError("does not begin with a number, but with " + odd->name + "; " + odd->remedy);
    throw UnitError("does not begin with a number; write a number and a unit, such as " + example(si_unit));
  }
  if (error == std::errc::result_out_of_range || !std::isfinite(number))
    throw UnitError("is not a finite number; write one such as " + example(si_unit));
  const std::string rest(trimmed(text.substr(static_cast<std::size_t>(end - text.data()))));
  if (!rest.empty() && rest[0] == ',')
    throw UnitError("has a comma in the number; decimals are written with a point, such as " +
                    example(si_unit));
  if (const auto odd = odd_character_in(rest))
    throw UnitError("has " + odd->name + " in its unit; " + odd->remedy);
  return {number, rest};
}

/// Conversion from a unit as written to an SI unit.
struct Conversion {
  Converter converter;
  double turns_to_radians = 1;

  double operator()(double number) const {
    return cv_convert_double(converter.get(), number) * turns_to_radians;
  }
};

/// The parser of udunits is not reentrant.
std::mutex& parser_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Conversions of the texts that were read before: sweeps read a scene thousands of times. Emptied beyond
/// 1000 entries.
std::map<std::pair<std::string, std::string>, Conversion>& known_conversions() {
  static std::map<std::pair<std::string, std::string>, Conversion> known;
  constexpr std::size_t most = 1000;
  if (known.size() > most) known.clear();
  return known;
}

}  // namespace

double to_si(const std::string& quantity, const std::string& si_unit) {
  const auto [number, unit_text] = split(quantity, si_unit);
  const std::lock_guard<std::mutex> lock(parser_mutex());
  const auto finite = [&](double value) {
    if (!std::isfinite(value))
      throw UnitError("is not finite in " + si_unit + "; write a number such as " + example(si_unit));
    return value;
  };
  auto& known = known_conversions();
  if (const auto conversion = known.find({unit_text, si_unit}); conversion != known.end())
    return finite(conversion->second(number));
  ut_system* const system = unit_system();
  const Unit wanted(ut_parse(system, si_unit.c_str(), UT_UTF8));
  if (!wanted) throw std::logic_error("unknown SI unit \"" + si_unit + "\" in the program");
  const Dimension wanted_dimension = dimension_of(wanted.get());
  if (unit_text.empty()) {
    if (wanted_dimension.empty()) return number;
    throw UnitError("has no unit; write " + example(si_unit) + ", or the number without quotes in " +
                    si_unit);
  }
  const Unit unit(is_well_formed(unit_text) ? ut_parse(system, unit_text.c_str(), UT_UTF8) : nullptr);
  if (!unit)
    throw UnitError("has an unknown unit \"" + unit_text + "\"; write " + example(si_unit) +
                    " (case counts: MPa, kN, Hz; a space or * between factors: N s/m)");

  const Dimension dimension = dimension_of(unit.get());
  double turns_to_radians = 1;
  if (dimension != wanted_dimension) {
    const bool is_frequency = dimension == Dimension{{"s", -1}};
    if (wanted_dimension != Dimension{{"rad", 1}, {"s", -1}} || !is_frequency)
      throw UnitError("\"" + unit_text + "\" is no unit of this quantity (SI unit " + si_unit + "); write " +
                      example(si_unit));
    if (!ends_with(unit_text, "Hz") && !ends_with(unit_text, "hertz"))
      throw UnitError("\"" + unit_text + "\" does not say whether it counts turns or radians; write " +
                      example(si_unit));
    turns_to_radians = 2 * pi;
  }
  Converter converter(ut_get_converter(unit.get(), wanted.get()));
  if (!converter) throw UnitError("cannot be converted to " + si_unit + "; write " + example(si_unit));
  Conversion conversion{std::move(converter), turns_to_radians};
  return finite(known.emplace(std::pair(unit_text, si_unit), std::move(conversion)).first->second(number));
}

bool is_unit(const std::string& text) {
  if (text.empty() || !is_well_formed(text)) return false;
  const std::lock_guard<std::mutex> lock(parser_mutex());
  return Unit(ut_parse(unit_system(), text.c_str(), UT_UTF8)) != nullptr;
}

double parse_ratio(const std::string& text) {
  const std::string remedy = "is no ratio of whole numbers; write a fraction such as \"-1/20\"";
  std::string_view numerator = text, denominator = "1";
  if (const auto slash = numerator.find('/'); slash != std::string_view::npos) {
    denominator = trimmed(numerator.substr(slash + 1));
    numerator = numerator.substr(0, slash);
  }
  numerator = trimmed(numerator);
  int p = 0, q = 0;
  for (const auto& [digits, value] : {std::pair{numerator, &p}, std::pair{denominator, &q}}) {
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, *value);
    if (error != std::errc{} || stop != end) throw UnitError(remedy);
  }
  if (q <= 0) throw UnitError("has a denominator that is not positive; write a fraction such as \"-1/20\"");
  return static_cast<double>(p) / q;
}

}  // namespace pipelines
