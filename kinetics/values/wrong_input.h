/// How kinetics refuses wrong input: one sentence with the parameter, its value and the remedy.
#pragma once

#include <string>
#include <vector>

namespace kinetics {

/// A number as it reads best in a message: up to 12 significant digits.
std::string number(double value);
/// One that was computed, in a warning: four significant digits, or as many as tell it from a number beside
/// it.
std::string rounded(double value, int digits = 4);

/// @throws MachineRefused, always: "<parameter> = <value>: <remedy>"
[[noreturn]] void refuse(const std::string& parameter, double value, const std::string& remedy);

/// Lets numbers through and refuses NaN and infinity.
/// @throws MachineRefused if the value is not finite
void require_finite(const std::string& parameter, double value);

/// The known word with the smallest edit_distance; empty if `known` is.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// The words in one line, separated by ", ".
std::string listed(const std::vector<std::string>& words);

}  // namespace kinetics
