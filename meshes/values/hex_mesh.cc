#include "meshes/values/hex_mesh.h"

#include <algorithm>

namespace meshes {

CellMesh to_cell_mesh(const HexMesh& mesh) {
  CellMesh result;
  result.kind = CellKind::hexahedra;
  result.points = mesh.points;
  std::vector<const Hex*> hexes;
  for (const Hex& hex : mesh.hexes) hexes.push_back(&hex);
  std::stable_sort(hexes.begin(), hexes.end(),
                   [](const Hex* a, const Hex* b) { return a->volume_id < b->volume_id; });
  for (const Hex* hex : hexes) {
    result.cells.insert(result.cells.end(), hex->nodes.begin(), hex->nodes.end());
    result.volume_id.push_back(hex->volume_id);
  }
  for (const BoundaryQuad& quad : mesh.quads) {
    result.faces.insert(result.faces.end(), quad.nodes.begin(), quad.nodes.end());
    result.face_id.push_back(quad.boundary_id);
  }
  return result;
}

}  // namespace meshes
