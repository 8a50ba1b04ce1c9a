/// A finished mesh of linear hexahedra with group ids, before it is written. Lengths in m.
#pragma once

#include <array>
#include <vector>

namespace meshes {

using Point = std::array<double, 3>;  ///< x, y, z in m

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

}  // namespace meshes
