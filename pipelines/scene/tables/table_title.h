/// Titles of columns with the unit in them, as loggers write them.
#pragma once

#include <string>

namespace pipelines {

struct TableTitle {
  std::string text;  ///< as written, without quotes
  std::string name;  ///< without the unit
  std::string unit;  ///< in the spelling of base/names/units.h; empty: none
  /// The unit stands in brackets: it is one, or wrong. Others may be a part of the name, as "(left)" is.
  bool is_in_brackets = false;
  std::string fault;  ///< what is wrong with the title, with the remedy; empty: nothing
};

/// "Kraft X [N]", "Moment (Nm)", "F / kN", "F in kN", "F, kN"; all else is a name. An ending such as "_N" is
/// left to without_unit_suffix: only who knows the quantity can tell it from a name.
TableTitle parse_title(const std::string& text);

/// "time_s" and "s" give "time" with that unit; a title whose ending is no unit of the quantity comes back as
/// it is. Titles that have a unit do, too.
TableTitle without_unit_suffix(const TableTitle& title, const std::string& si_unit);

/// The unit as base/names/units.h spells it: without brackets, "Grad" as "deg", "Sek" as "s", "U" as "turn",
/// "kp" as "kgf"; a hyphen alone is none.
std::string unit_as_we_spell_it(const std::string& written);

/// Text without blanks around it, ordinary ones and no-break spaces.
std::string without_blanks(const std::string& text);

}  // namespace pipelines
