/// A body with its unit loads as a model for CalculiX: C3D20 where we have 27-node hexahedra, C3D10 for
/// tetrahedra. SI units; node i of ours is node i + 1, cell i is element i + 1.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fem/equations/loads/nodal_loads.h"
#include "pipelines/command/calculix/serendipity.h"

namespace pipelines {

/// Forces for the nodes that CalculiX has, of the same surface and body loads.
struct CalculixForces {
  std::vector<double> force_N;  ///< K x n x 3, zero where nodes are dropped
  /// Moment that the loads have gained by the nodes dropped, as curved faces and cells lose their middle:
  /// largest over the loads, over the sum of |f| times the distance from the centre. A rigid-mode body force
  /// has taken it out.
  double moment_removed = 0;
};

/// P' f (serendipity.h), closed again.
CalculixForces calculix_forces(const fem::NodalLoads& loads, const Serendipity& nodes);

/// Writes nodes, elements, material, the support that carries nothing, and one linear *STATIC step per load
/// with its nodal forces; results in the .frd (U at nodes, S extrapolated to nodes and averaged).
/// @param channels  names of the loads, in comments
/// @throws FileError naming the file if it cannot be written
void write_calculix_model(const std::filesystem::path& file, const std::string& title,
                          const std::vector<std::string>& channels, const fem::Material& material,
                          const fem::NodalLoads& loads);

}  // namespace pipelines
