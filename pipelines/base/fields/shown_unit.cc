#include "pipelines/base/fields/shown_unit.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "pipelines/base/fields/quantity.h"

namespace pipelines {

double ShownUnit::value(double si) const {
  if (one == 1 || !std::isfinite(si)) return si;
  return std::strtod(fmt::format("{:.15g}", si / one).c_str(), nullptr);
}

ShownUnit shown_unit(const std::string& si_unit) {
  static const std::map<std::string, Quantity> others{{"Pa", quantities::stress},
                                                      {"m", quantities::length},
                                                      {"m3", quantities::volume},
                                                      {"rad", quantities::angle},
                                                      {"1/m", quantities::related_gradient}};
  const auto other = others.find(si_unit);
  return other == others.end() ? ShownUnit{si_unit, 1} : ShownUnit{other->second.unit, other->second.one};
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
