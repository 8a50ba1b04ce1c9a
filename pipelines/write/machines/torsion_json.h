/// Pieces that summary.json and `millstress torsion --json` share.
#pragma once

#include <nlohmann/json.hpp>

#include "pipelines/judge/verdict/torsion_report.h"

namespace pipelines {

/// Torques in the steady state, by element.
nlohmann::ordered_json train_elements_json(const TorsionReport& report);

/// Margins of each excitation frequency against the natural frequency nearest to it, closest first.
nlohmann::ordered_json margins_json(const TorsionReport& report);

}  // namespace pipelines
