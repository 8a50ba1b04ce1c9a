#include "pipelines/report_parts/damage_share_text.h"

#include <utility>

#include "pipelines/report_parts/zone_text.h"

namespace pipelines {

std::string damage_text(const std::vector<std::string>& effects, const std::vector<double>& shares,
                        bool is_damaged) {
  if (shares.empty()) return "";
  return (is_damaged ? "damage by " : "damage, if all loads grew until there is some, by ") +
         largest_shares(group_shares(effects, shares));
}

summary::Json effect_shares_json(const std::vector<std::string>& effects, const std::vector<double>& shares) {
  auto json = summary::Json::object();
  for (std::size_t e = 0; e < shares.size(); ++e) json[effects[e]] = summary::number(shares[e]);
  return json;
}

void add_shares(std::vector<CsvColumn>& columns, const std::string& prefix,
                const std::vector<std::string>& effects, const std::vector<std::vector<double>>& shares) {
  for (std::size_t e = 0; e < effects.size(); ++e) {
    std::vector<std::string> cells;
    for (const auto& row : shares) cells.push_back(row.empty() ? std::string() : shortest(row[e]));
    columns.push_back({prefix + effects[e], "", std::move(cells)});
  }
}

void add_damage_shares(std::vector<CsvColumn>& columns, const std::vector<std::string>& effects,
                       const std::vector<std::vector<double>>& shares) {
  add_shares(columns, "damage_share_", effects, shares);
}

}  // namespace pipelines
