/// How the rules of fatigue refuse wrong input: one sentence with the value's name, the value and its range.
#pragma once

#include <string>

namespace pipelines {

/// @throws std::invalid_argument, always: "<name> = <value>: <remedy>"
[[noreturn]] void refuse_fatigue_input(const std::string& name, double value, const std::string& remedy);

/// @throws std::invalid_argument unless the value is finite and greater than zero
void require_positive_input(const std::string& name, double value);

/// @throws std::invalid_argument unless the value is finite and not less than zero
void require_non_negative_input(const std::string& name, double value);

/// @throws std::invalid_argument unless the value is finite
void require_finite_input(const std::string& name, double value);

/// @throws std::invalid_argument unless least <= value <= most
void require_input_between(const std::string& name, double value, double least, double most);

}  // namespace pipelines
