#include "pipelines/judge/texts/damage_share_text.h"

#include "pipelines/judge/texts/zone_text.h"

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

}  // namespace pipelines
