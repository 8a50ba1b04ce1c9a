#include "tests/verification/fem/block_mesh.h"

#include <fstream>
#include <map>
#include <string>

#include "tests/unit/fem/examples/scratch_directory.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace verification {

namespace {

std::filesystem::path next_file() {
  static const fem_tests::ScratchDirectory scratch;
  static int number = 0;
  return scratch.path() / ("block_" + std::to_string(number++) + ".msh");
}

}  // namespace

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

std::filesystem::path write(const HexahedraMesh& mesh) {
  auto path = next_file();
  std::ofstream out(path);
  out.precision(17);
  std::map<int, std::vector<std::size_t>> volumes;  // cells of each
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    volumes[mesh.volumes.empty() ? int(block_volume) : mesh.volumes[c]].push_back(c);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 6 " << volumes.size() << "\n";
  for (int side = begin_1; side <= end_3; ++side) out << side << " 0 0 0 1 1 1 1 " << side << " 0\n";
  for (const auto& [volume, cells] : volumes) out << volume << " 0 0 0 1 1 1 1 " << volume << " 0\n";
  out << "$EndEntities\n$Nodes\n1 " << mesh.nodes.size() << " 1 " << mesh.nodes.size() << "\n3 "
      << volumes.begin()->first << " 0 " << mesh.nodes.size() << "\n";
  for (std::size_t i = 1; i <= mesh.nodes.size(); ++i) out << i << "\n";
  for (const auto& x : mesh.nodes) out << x[0] << " " << x[1] << " " << x[2] << "\n";
  const auto n_elements = mesh.faces.size() + mesh.cells.size();
  out << "$EndNodes\n$Elements\n"
      << mesh.faces.size() + volumes.size() << " " << n_elements << " 1 " << n_elements << "\n";
  std::size_t next = 1;
  for (const auto& [corners, side] : mesh.faces) {
    out << "2 " << side << " 3 1\n" << next++;
    for (const int i : corners) out << " " << i + 1;
    out << "\n";
  }
  for (const auto& [volume, cells] : volumes) {
    out << "3 " << volume << " 5 " << cells.size() << "\n";
    for (const auto c : cells) {
      out << next++;
      for (const int i : mesh.cells[c]) out << " " << i + 1;
      out << "\n";
    }
  }
  out << "$EndElements\n";
  return path;
}

std::filesystem::path write_hexahedra(const Block& block) {
  return write(hexahedra(block));
}

std::filesystem::path write_tetrahedra(const Block& block) {
  auto path = next_file();
  std::ofstream(path) << fem_tests::as_msh(fem_tests::tetrahedra_block(block.cells, block.map));
  return path;
}

}  // namespace verification
