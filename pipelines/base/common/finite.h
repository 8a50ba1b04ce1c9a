/// Nothing that is not finite leaves a stage: the refusal that all guards share (finite_loads.h,
/// finite_stress.h).
#pragma once

#include <string>

namespace pipelines {

/// @param stage  "loads", "torsion" ...
/// @param what   the quantity and its unit
/// @param where  " at node 12"; may be empty
/// @throws NotFinite, always
[[noreturn]] void refuse_not_finite(const std::string& stage, const std::string& what,
                                    const std::string& where);

/// @throws NotFinite naming stage and quantity if the value is infinite or no number
void require_finite(const std::string& stage, const std::string& what, double value);

}  // namespace pipelines
