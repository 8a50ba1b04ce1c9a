/// What report.html shows of torsion, from summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "pipelines/write/exports/html_page.h"

namespace pipelines {

/// Resonance margins of a drive train; nothing of other machines.
/// @param summary  all of summary.json
void add_resonance_margins(HtmlPage& page, const nlohmann::ordered_json& summary);

/// Torques of a shaft's elements, and its start, where there are any.
/// @param body  summary.json's bodies.<body>
void add_shaft_torsion(HtmlPage& page, const nlohmann::ordered_json& body);

}  // namespace pipelines
