/// Our iteration and our factor beside conjugate gradients with deal.II's global-coarsening multigrid, on
/// even and on locally refined meshes.
#pragma once

#include <filesystem>

namespace measure {

/// Prints a table: the benchmark shaft on even meshes; shaft and chamber of a scene as a search for 5 %
/// leaves them.
/// @param shaft_toml  of benchmarks/
/// @param mill_toml   a scene with a shaft and a chamber
/// @throws std::runtime_error if displacements differ by more than the tolerances of both explain
void compare_multigrid(const std::filesystem::path& shaft_toml, const std::filesystem::path& mill_toml);

}  // namespace measure
