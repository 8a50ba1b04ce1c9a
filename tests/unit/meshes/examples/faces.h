/// Faces of hexahedra, found by their nodes.
#pragma once

#include <algorithm>
#include <array>
#include <map>

#include "tests/unit/meshes/examples/mesh_file.h"

/// The six faces, outward, in gmsh's node order.
inline constexpr int hex_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

using FaceKey = std::array<int, 4>;

inline FaceKey key_of(std::array<int, 4> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// How many cells share each face, and the face as one of them sees it.
struct FaceUse {
  int n_cells = 0;
  std::array<int, 4> nodes{};
};

inline std::map<FaceKey, FaceUse> count_faces(const MeshFile& mesh) {
  std::map<FaceKey, FaceUse> faces;
  for (const auto& hex : mesh.hexes)
    for (const auto& face : hex_faces) {
      std::array<int, 4> nodes;
      for (int i = 0; i < 4; ++i) nodes[i] = hex.nodes[face[i]];
      FaceUse& use = faces[key_of(nodes)];
      ++use.n_cells;
      use.nodes = nodes;
    }
  return faces;
}
