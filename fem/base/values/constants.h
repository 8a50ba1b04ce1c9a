/// Numbers that many files need.
#pragma once

namespace fem {

inline constexpr double pi = 3.14159265358979323846;

}  // namespace fem
