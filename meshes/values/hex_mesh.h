/// A finished mesh of linear hexahedra with group ids, as the structured meshers make it. Lengths in m.
#pragma once

#include <array>
#include <vector>

#include "meshes/values/cell_mesh.h"

namespace meshes {

/// Nodes in gmsh's (and VTK's) order: a face counter-clockwise seen from inside, then the opposite one.
struct Hex {
  std::array<int, 8> nodes{};
  int volume_id = 0;
};

/// Corners counter-clockwise seen from outside.
struct BoundaryQuad {
  std::array<int, 4> nodes{};
  int boundary_id = 0;
};

struct HexMesh {
  std::vector<Point> points;
  std::vector<Hex> hexes;
  std::vector<BoundaryQuad> quads;
};

/// The same as plain arrays, volume group after volume group.
CellMesh to_cell_mesh(const HexMesh& mesh);

}  // namespace meshes
