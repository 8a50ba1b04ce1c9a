#pragma once

namespace pipelines {

/// Version of the program, as in CMakeLists.txt.
inline constexpr const char* version = MILLSTRESS_VERSION;

}  // namespace pipelines
