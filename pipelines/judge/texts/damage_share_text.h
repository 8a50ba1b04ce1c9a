/// Shares of the effects in damage, as texts and JSON.
#pragma once

#include <string>
#include <vector>

#include "pipelines/base/fields/json_values.h"

namespace pipelines {

/// "damage by belt 83 %, drive 17 %", by groups of effects; of a place that endures "damage, if all loads
/// grew until there is some, by ...". Empty without shares: nothing changes.
std::string damage_text(const std::vector<std::string>& effects, const std::vector<double>& shares,
                        bool is_damaged);

/// Shares by effect; empty without shares.
summary::Json effect_shares_json(const std::vector<std::string>& effects, const std::vector<double>& shares);

}  // namespace pipelines
