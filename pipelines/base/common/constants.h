/// Numbers that many files need.
#pragma once

namespace pipelines {

inline constexpr double pi = 3.14159265358979323846;

}  // namespace pipelines
