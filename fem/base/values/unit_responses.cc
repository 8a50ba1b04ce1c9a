#include "fem/base/values/unit_responses.h"

namespace fem {

UnitResponses::UnitResponses() = default;
UnitResponses::UnitResponses(const UnitResponses&) = default;
UnitResponses::UnitResponses(UnitResponses&&) noexcept = default;
UnitResponses& UnitResponses::operator=(const UnitResponses&) = default;
UnitResponses& UnitResponses::operator=(UnitResponses&&) noexcept = default;
UnitResponses::~UnitResponses() = default;

}  // namespace fem
