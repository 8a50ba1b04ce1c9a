/// Shares of the effects in damage, as texts, JSON and columns of a table.
#pragma once

#include <string>
#include <vector>

#include "pipelines/files/csv.h"
#include "pipelines/report_parts/json_values.h"
#include "pipelines/report_parts/run_report.h"

namespace pipelines {

/// "damage by belt 83 %, drive 17 %", by groups of effects; of a place that endures "damage, if all loads
/// grew until there is some, by ...". Empty without shares: nothing changes.
std::string damage_text(const std::vector<std::string>& effects, const std::vector<double>& shares,
                        bool is_damaged);

/// By effect; empty without shares.
summary::Json effect_shares_json(const std::vector<std::string>& effects, const std::vector<double>& shares);

/// Adds a column "<prefix><effect>" for each effect; cells are empty where nothing changes.
/// @param shares  of each row; empty: nothing changes there
void add_shares(std::vector<CsvColumn>& columns, const std::string& prefix,
                const std::vector<std::string>& effects, const std::vector<std::vector<double>>& shares);

/// The same with "damage_share_".
void add_damage_shares(std::vector<CsvColumn>& columns, const std::vector<std::string>& effects,
                       const std::vector<std::vector<double>>& shares);

}  // namespace pipelines
