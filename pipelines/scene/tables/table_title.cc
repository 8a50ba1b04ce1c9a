#include "pipelines/scene/tables/table_title.h"

#include <map>

#include "pipelines/base/names/units.h"

namespace pipelines {
namespace {

bool converts(const std::string& unit, const std::string& si_unit) {
  try {
    to_si("1 " + unit, si_unit);
    return true;
  } catch (const UnitError&) {
    return false;
  }
}

/// What stands behind a place, as the unit, and what stands before it, as the name.
TableTitle split_at(const std::string& text, std::size_t end_of_name, const std::string& unit) {
  TableTitle title;
  title.text = text;
  title.name = without_blanks(text.substr(0, end_of_name));
  title.unit = unit_as_we_spell_it(unit);
  return title;
}

TableTitle in_brackets(const std::string& text, std::size_t open) {
  const auto close = text.find(']', open);
  auto title = split_at(text, open, text.substr(open + 1, close - open - 1));
  title.is_in_brackets = true;
  if (close == std::string::npos) title.fault = "the unit's bracket is not closed; write \"name [unit]\"";
  return title;
}

}  // namespace

std::string without_blanks(const std::string& text) {
  std::size_t begin = 0, end = text.size();
  const auto is_blank = [&](std::size_t i) { return text[i] == ' ' || text[i] == '\t' || text[i] == '\r'; };
  const auto is_no_break = [&](std::size_t i) { return text.compare(i, 2, "\xC2\xA0") == 0; };
  for (bool goes_on = true; goes_on && begin < end;) {
    goes_on = is_blank(begin) || is_no_break(begin);
    begin += !goes_on ? 0 : is_blank(begin) ? 1 : 2;
  }
  for (bool goes_on = true; goes_on && begin < end;) {
    const bool is_wide = end - begin >= 2 && is_no_break(end - 2);
    goes_on = is_wide || is_blank(end - 1);
    end -= is_wide ? 2 : goes_on ? 1 : 0;
  }
  return text.substr(begin, end - begin);
}

std::string unit_as_we_spell_it(const std::string& written) {
  static const std::map<std::string, std::string> ours{{"Grad", "deg"},   {"Sek", "s"},  {"sek", "s"},
                                                       {"Sekunden", "s"}, {"U", "turn"}, {"Umdr", "turn"},
                                                       {"Umdr.", "turn"}, {"kp", "kgf"}, {"degrees", "deg"},
                                                       {"-", ""},         {"", ""}};
  std::string unit = without_blanks(written);
  if (unit.size() > 1)
    for (const auto* pair : {"[]", "()"})
      if (unit.front() == pair[0] && unit.back() == pair[1])
        unit = without_blanks(unit.substr(1, unit.size() - 2));
  if (unit.rfind("in ", 0) == 0) unit = without_blanks(unit.substr(3));
  const auto found = ours.find(unit);
  return found == ours.end() ? unit : found->second;
}

TableTitle parse_title(const std::string& text) {
  if (const auto open = text.find('['); open != std::string::npos) return in_brackets(text, open);
  const auto open = text.rfind('(');
  if (open != std::string::npos && open > 0 && text.back() == ')')
    return split_at(text, open, text.substr(open + 1, text.size() - open - 2));
  // "v / m/s": the first stroke with blanks around it, or else the first one
  const auto apart = text.find(" / "), stroke = apart == std::string::npos ? text.find('/') : apart + 1;
  if (stroke != std::string::npos && stroke > 0) {
    auto title = split_at(text, stroke, text.substr(stroke + 1));
    if (is_unit(title.unit) || apart != std::string::npos) return title;
  }
  for (const std::string between : {" in ", ", "})
    if (const auto at = text.rfind(between); at != std::string::npos && at > 0)
      if (auto title = split_at(text, at, text.substr(at + between.size())); is_unit(title.unit))
        return title;
  return split_at(text, text.size(), "");
}

TableTitle without_unit_suffix(const TableTitle& title, const std::string& si_unit) {
  const auto line = title.text.rfind('_');
  if (!title.unit.empty() || line == std::string::npos || line == 0) return title;
  const auto shorter = split_at(title.text, line, title.text.substr(line + 1));
  return !shorter.unit.empty() && converts(shorter.unit, si_unit) ? shorter : title;
}

}  // namespace pipelines
