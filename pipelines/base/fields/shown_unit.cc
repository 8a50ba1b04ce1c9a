#include "pipelines/base/fields/shown_unit.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "pipelines/base/common/constants.h"

namespace pipelines {
double ShownUnit::value(double si) const {
  if (one == 1 || !std::isfinite(si)) return si;
  return std::strtod(fmt::format("{:.12g}", si / one).c_str(), nullptr);
}

ShownUnit shown_unit(const std::string& si_unit) {
  static const std::map<std::string, ShownUnit> others{{"Pa", {"MPa", 1e6}},
                                                       {"m", {"mm", 1e-3}},
                                                       {"m3", {"mm3", 1e-9}},
                                                       {"rad", {"deg", pi / 180}},
                                                       {"1/m", {"1/mm", 1e3}}};
  const auto other = others.find(si_unit);
  return other == others.end() ? ShownUnit{si_unit, 1} : other->second;
}

CsvColumn in_shown_unit(CsvColumn si) {
  const auto shown = shown_unit(si.unit);
  if (shown.unit == si.unit) return si;
  for (auto& value : std::get<std::vector<double>>(si.cells)) value = shown.value(value);
  si.unit = shown.unit;
  return si;
}

std::vector<CsvColumn> in_shown_units(std::vector<CsvColumn> si) {
  for (auto& column : si) column = in_shown_unit(std::move(column));
  return si;
}

}  // namespace pipelines
