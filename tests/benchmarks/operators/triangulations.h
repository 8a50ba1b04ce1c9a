/// deal.II's triangulations and finite elements that fem could number its nodes with.
#pragma once

#include <filesystem>

namespace measure {

/// The shaft of shaft.toml, its cells cut locally at random in three cycles, as a serial triangulation and as
/// one of p4est on one rank, with one scalar element and with three components. Prints seconds and bytes.
/// @param shaft_toml  that file
/// @throws std::runtime_error if the four do not have the same cells and nodes
void compare_triangulations(const std::filesystem::path& shaft_toml);

}  // namespace measure
