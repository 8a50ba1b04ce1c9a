#include "pipelines/base/fatigue/technological_size.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/fatigue/fatigue_input.h"

namespace pipelines {
namespace {

constexpr double no_limit_mm = 1e9, largest_rolled_mm = 250;

struct SizeConstants {
  MaterialGroup group;
  const char* name;
  double tensile_mm, tensile_a_d;  ///< d_eff,N,m and a_d,m
  double yield_mm, yield_a_d;      ///< d_eff,N,p and a_d,p
  double largest_mm;
};

const std::vector<SizeConstants>& size_constants() {
  using G = MaterialGroup;
  static const std::vector<SizeConstants> rows = {
      {G::steel, "structural steel", 40, 0.15, 40, 0.3, largest_rolled_mm},
      {G::steel, "quenched and tempered steel", 16, 0.3, 16, 0.4, largest_rolled_mm},
      {G::case_hardening_steel, "case-hardening steel", 11, 0.5, 11, 0.5, largest_rolled_mm},
      {G::forging_steel, "quenched and tempered forging steel", 250, 0.2, 250, 0.25, no_limit_mm},
      {G::cast_steel, "cast steel", 100, 0.15, 100, 0.3, no_limit_mm},
      {G::ductile_cast_iron, "ductile cast iron", 60, 0.15, 60, 0.15, no_limit_mm},
      {G::malleable_cast_iron, "malleable cast iron", 15, 0.15, 15, 0.15, no_limit_mm}};
  return rows;
}

double factor_by_logarithm(double d_mm, double reference_mm, double a_d) {
  if (d_mm <= reference_mm) return 1;
  const auto relative = [&](double of_mm) { return 1 - 0.7686 * a_d * std::log10(of_mm / 7.5); };
  return relative(d_mm) / relative(reference_mm);
}

double factor_of_grey_iron(double d_mm) {
  return 1.207 * std::pow(std::max(d_mm, 7.5) / 7.5, -0.1922);
}

}  // namespace

std::vector<SizeOfMaterial> sizes_of(MaterialGroup group, double effective_diameter_m) {
  require_positive_input("effective_diameter_m", effective_diameter_m);
  const double d_mm = 1e3 * effective_diameter_m;
  if (group == MaterialGroup::grey_cast_iron)
    return {{"grey cast iron", 0.020, factor_of_grey_iron(d_mm), 1}};
  std::vector<SizeOfMaterial> sizes;
  for (const auto& row : size_constants()) {
    if (row.group != group) continue;
    const double counted_mm = std::min(d_mm, row.largest_mm);
    sizes.push_back({row.name, 1e-3 * row.tensile_mm,
                     factor_by_logarithm(counted_mm, row.tensile_mm, row.tensile_a_d),
                     factor_by_logarithm(counted_mm, row.yield_mm, row.yield_a_d)});
  }
  std::stable_sort(sizes.begin(), sizes.end(),
                   [](const auto& a, const auto& b) { return a.tensile_factor > b.tensile_factor; });
  return sizes;
}

}  // namespace pipelines
