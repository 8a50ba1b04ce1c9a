/// What CalculiX leaves: displacements and stresses of its .frd file (format of cgx, in text).
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace pipelines {

/// Step after step; zero at nodes that the file does not name.
struct CalculixResults {
  std::size_t n_steps = 0;
  std::vector<double> displacement_m;  ///< n_steps x n x 3
  std::vector<double> stress_Pa;       ///< n_steps x n x 6: xx, yy, zz, xy, yz, xz, means over elements
};

/// @param n_nodes  number of nodes of our mesh; CalculiX numbers them from 1
/// @throws FileError naming file and line for a file that is missing, broken off, of another format,
/// has other nodes, or lacks displacements or stresses of a step
CalculixResults read_calculix_results(const std::filesystem::path& frd, std::size_t n_nodes);

}  // namespace pipelines
