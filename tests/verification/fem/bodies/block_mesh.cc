#include "tests/verification/fem/bodies/block_mesh.h"

#include "tests/unit/fem/examples/tetrahedra.h"

namespace verification {

HexahedraMesh hexahedra(const Block& block) {
  const auto& n = block.cells;
  const int rows = block.is_ring ? n[1] : n[1] + 1;
  const auto number = [&](int i, int j, int k) { return i + (n[0] + 1) * (j % rows + rows * k); };
  HexahedraMesh mesh;
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i <= n[0]; ++i)
        mesh.nodes.push_back(block.map(Point(double(i) / n[0], double(j) / n[1], double(k) / n[2])));
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const std::array<int, 8> c = {number(i, j, k),
                                      number(i + 1, j, k),
                                      number(i + 1, j + 1, k),
                                      number(i, j + 1, k),
                                      number(i, j, k + 1),
                                      number(i + 1, j, k + 1),
                                      number(i + 1, j + 1, k + 1),
                                      number(i, j + 1, k + 1)};
        mesh.cells.push_back(c);
        if (block.volume) mesh.volumes.push_back(block.volume({i, j, k}));
        if (i == 0) mesh.faces.push_back({{c[0], c[4], c[7], c[3]}, begin_1});
        if (i + 1 == n[0]) mesh.faces.push_back({{c[1], c[2], c[6], c[5]}, end_1});
        if (j == 0 && !block.is_ring) mesh.faces.push_back({{c[0], c[1], c[5], c[4]}, begin_2});
        if (j + 1 == n[1] && !block.is_ring) mesh.faces.push_back({{c[3], c[7], c[6], c[2]}, end_2});
        if (k == 0) mesh.faces.push_back({{c[0], c[3], c[2], c[1]}, begin_3});
        if (k + 1 == n[2]) mesh.faces.push_back({{c[4], c[5], c[6], c[7]}, end_3});
      }
  return mesh;
}

Cells cells_of(const HexahedraMesh& mesh) {
  fem::CoarseMesh cells;
  for (const auto& x : mesh.nodes) cells.points_m.push_back({x[0], x[1], x[2]});
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    cells.cells.insert(cells.cells.end(), mesh.cells[c].begin(), mesh.cells[c].end());
    cells.volume_id.push_back(mesh.volumes.empty() ? int(block_volume) : mesh.volumes[c]);
  }
  for (const auto& [corners, side] : mesh.faces) {
    cells.faces.insert(cells.faces.end(), corners.begin(), corners.end());
    cells.face_id.push_back(side);
  }
  return std::make_shared<const fem::CoarseMesh>(std::move(cells));
}

Cells hexahedra_of(const Block& block) {
  return cells_of(hexahedra(block));
}

Cells tetrahedra_of(const Block& block) {
  return fem_tests::cells_of(fem_tests::tetrahedra_block(block.cells, block.map));
}

}  // namespace verification
