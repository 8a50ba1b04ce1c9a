/// Columns of CSV whose quantities are known by their SI unit alone, such as those of a load history.
#pragma once

#include <string>

#include "pipelines/base/files/csv.h"

namespace pipelines {

/// The unit in which people read a quantity.
struct ShownUnit {
  std::string unit;
  double one = 1;  ///< in the SI unit
  /// The value with fifteen digits where the unit is another.
  double value(double si) const;
};

/// MPa for Pa, mm for m, mm3 for m3, deg for rad, 1/mm for 1/m; others as they are.
ShownUnit shown_unit(const std::string& si_unit);

/// The column in the unit in which people read it.
/// @param si  numbers in SI, `unit` among them
CsvColumn in_shown_unit(CsvColumn si);
std::vector<CsvColumn> in_shown_units(std::vector<CsvColumn> si);

}  // namespace pipelines
