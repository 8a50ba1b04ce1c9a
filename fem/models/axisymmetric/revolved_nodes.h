/// The section turned into nodes, cells and faces of the whole body. Internal to fem.
#pragma once

#include <cstddef>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "fem/models/axisymmetric/meridian_grid.h"

namespace fem {

/// Where the nodes of a result point are: `n_angles` of them one after the other, the first at +x, or a
/// single one on the axis.
struct RevolvedNodes {
  Nodes nodes;
  std::vector<std::size_t> first;  ///< by result point, and their number at the end

  std::size_t n_at(std::size_t point) const { return first[point + 1] - first[point]; }
};

/// Hexahedra of degree 1 between the half planes: of quadrilaterals, and of the triangles of a fan, whose
/// fourth corner is the first one again. At the axis they collapse. Volumes of nodes are shares of the exact
/// rings; faces are those of the surface, two on each of its edges. All cells belong to the volume group 0.
RevolvedNodes revolve(const MeridianGrid& grid, int n_angles);

}  // namespace fem
