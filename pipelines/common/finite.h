/// Nothing that is not finite leaves a stage: one guard for each.
#pragma once

#include <string>
#include <vector>

#include "fem/values/unit_responses.h"
#include "kinetics/load_history.h"
#include "pipelines/loads/load_book.h"
#include "pipelines/superposition/superposition.h"

namespace pipelines {

struct TorsionReport;

/// @param stage  "loads", "torsion" ...
/// @param what   the quantity and its unit
/// @throws NotFinite naming stage and quantity if the value is infinite or no number
void require_finite(const std::string& stage, const std::string& what, double value);

// Each throws NotFinite naming the stage, the first quantity that is not finite, and when or where.
void require_finite(const kinetics::LoadHistory& loads);   ///< but for quantities that have poles
void require_finite(const BodyLoads& loads);               ///< distribution
void require_finite(const fem::UnitResponses& responses);  ///< solve and stress recovery
void require_finite(const std::string& body, const Envelope& envelope);  ///< superposition
void require_finite(const TorsionReport& torsion);

}  // namespace pipelines
