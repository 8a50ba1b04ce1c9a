/// How far apart two names are, for "did you mean ...".
#pragma once

#include <cstddef>
#include <string>

namespace kinetics {

/// Fewest edits (insert, delete, replace a letter, swap two neighbours) from one name to the other, letters
/// compared without case; no part of a name is edited twice (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b);

}  // namespace kinetics
