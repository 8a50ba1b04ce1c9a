/// What report.html shows of fatigue, from summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "pipelines/write/exports/html_page.h"

namespace pipelines {

/// Places and weld toes by falling use, where the scene asks for fatigue.
/// @param body  summary.json's bodies.<body>
void add_fatigue(HtmlPage& page, const nlohmann::ordered_json& body);

/// Ranking of all bodies, where there are several.
/// @param summary  all of summary.json
void add_fatigue_ranking(HtmlPage& page, const nlohmann::ordered_json& summary);

/// Operating blocks, and the lives over all of them.
/// @param summary  all of summary.json
void add_duty(HtmlPage& page, const nlohmann::ordered_json& summary);

}  // namespace pipelines
