/// A slender round bar between two short bearing seats, on a coarse mesh: a run of the program in a second.
#pragma once

#include <string>
#include <vector>

#include "tests/cases/program/program.h"

namespace cases {

/// One entry of the load table, in axes that turn with the shaft; order 0 is a constant. Entries may be of
/// one effect.
struct SmallLoad {
  std::string effect, load, size;
  int order = 0;
  std::string phase{};
};

/// Of a force that is fixed in space: it goes round the shaft once a turn.
std::vector<SmallLoad> fixed_in_space(const std::string& effect, const std::string& port,
                                      const std::string& force);

/// Diameter 10, seats of 4 at both ends, 400 from middle to middle of them, in units of `unit`.
inline constexpr double small_diameter = 10, small_span = 400;

std::string small_shaft(const std::vector<SmallLoad>& loads, const std::string& unit = "mm",
                        const std::string& speed = "600 rpm",
                        const std::string& keys = "natural_frequencies = 2");

nlohmann::json run_small(const fs::path& directory, const std::string& scene, std::string* out = nullptr);

}  // namespace cases
