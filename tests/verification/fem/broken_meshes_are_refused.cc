// Meshes that no solver should see: in pieces, hinged, with cells that are flat or inside out. The message
// names the cell or the pieces, a place, and what to do.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/unit/fem/examples/scratch_directory.h"
#include "tests/unit/fem/examples/tetrahedra.h"
#include "tests/verification/fem/block_mesh.h"
#include "tests/verification/fem/figures.h"

namespace {

using verification::Point;

verification::HexahedraMesh cube(const Point& corner) {
  verification::Block block;
  block.cells = {2, 2, 2};
  block.map = [corner](const Point& c) { return Point(corner + c); };
  return verification::hexahedra(block);
}

/// Both, each with nodes of its own; nodes of the second at a node of the first are joined if asked for.
verification::HexahedraMesh together(verification::HexahedraMesh mesh,
                                     const verification::HexahedraMesh& other, bool join) {
  std::vector<int> number;
  const auto n_first = mesh.nodes.size();
  for (const auto& x : other.nodes) {
    std::size_t found = n_first;
    for (std::size_t i = 0; join && i < n_first; ++i)
      if ((mesh.nodes[i] - x).norm() < 1e-12) found = i;
    number.push_back(int(found < n_first ? found : mesh.nodes.size()));
    if (found == n_first) mesh.nodes.push_back(x);
  }
  for (auto cell : other.cells) {
    for (int& node : cell) node = number[node];
    mesh.cells.push_back(cell);
  }
  for (const auto& other_face : other.faces) {
    auto face = other_face.first;
    for (int& node : face) node = number[node];
    const auto sorted = [](std::array<int, 4> corners) {
      std::sort(corners.begin(), corners.end());
      return corners;
    };
    const auto twin = std::find_if(mesh.faces.begin(), mesh.faces.end(),
                                   [&](const auto& known) { return sorted(known.first) == sorted(face); });
    if (twin == mesh.faces.end())
      mesh.faces.push_back({face, other_face.second});
    else
      mesh.faces.erase(twin);  // inside now
  }
  return mesh;
}

std::string refusal(const std::filesystem::path& file) {
  fem::Body body;
  body.mesh = file;
  body.material = {200e9, 0.3, 7850};
  try {
    fem::Model model(body);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

TEST(BrokenMesh, InTwoPieces) {
  expect_words(
      refusal(verification::write(together(cube({0, 0, 0}), cube({3, 0, 0}), true))),
      {"2 pieces", "8 cells near (0.25, 0.25, 0.25) m", "8 cells near (3.25, 0.25, 0.25) m", "join them"});
}

// What a mesher leaves of two solids that were never fragmented: they touch, and share no node.
TEST(BrokenMesh, SideBySideWithoutCommonNodes) {
  expect_words(refusal(verification::write(together(cube({0, 0, 0}), cube({1, 0, 0}), false))), {"2 pieces"});
}

TEST(BrokenMesh, HingedAtAnEdgeOrACorner) {
  expect_words(refusal(verification::write(together(cube({0, 0, 0}), cube({1, 1, 0}), true))),
               {"2 pieces that share no face"});
  expect_words(refusal(verification::write(together(cube({0, 0, 0}), cube({1, 1, 1}), true))), {"2 pieces"});
}

TEST(BrokenMesh, ManyPiecesAreCountedAndTheLargestNamed) {
  auto mesh = cube({0, 0, 0});
  for (int k = 1; k < 8; ++k) {
    verification::Block one;
    one.map = [k](const Point& c) { return Point(c + Point(0, 0, 4 * k)); };
    mesh = together(std::move(mesh), verification::hexahedra(one), true);
  }
  expect_words(refusal(verification::write(mesh)), {"8 pieces", ": 8 cells near (0.25, 0.25, 0.25) m",
                                                    "1 cells near (0.5, 0.5, 4.5) m", "and others"});
}

TEST(BrokenMesh, OfTetrahedraInTwoPieces) {
  auto grid = fem_tests::tetrahedra_cube(1, [](const Point& p) { return p; });
  const auto other = fem_tests::tetrahedra_cube(1, [](const Point& p) { return Point(p + Point(0, 5, 0)); });
  const auto n_nodes = std::int32_t(grid.n_nodes), n_cells = std::int32_t(grid.n_cells());
  grid.xyz_m.insert(grid.xyz_m.end(), other.xyz_m.begin(), other.xyz_m.end());
  for (const auto node : other.cell_nodes) grid.cell_nodes.push_back(node + n_nodes);
  for (const int id : other.volume_id) grid.volume_id.push_back(id);
  for (auto face : other.boundary) {
    face.cell += n_cells;
    grid.boundary.push_back(face);
  }
  grid.n_nodes += other.n_nodes;
  const fem_tests::ScratchDirectory scratch;
  std::ofstream(scratch.path() / "two.msh") << fem_tests::as_msh(grid);
  expect_words(refusal(scratch.path() / "two.msh"), {"2 pieces", "6 cells near", "in volume 7"});
}

TEST(BrokenMesh, JoinedCubesAreOnePiece) {
  EXPECT_EQ(refusal(verification::write(together(cube({0, 0, 0}), cube({1, 0, 0}), true))), "accepted");
}

// The middle node of the cube, cell after cell: flat, then beyond the opposite corner.
TEST(BrokenMesh, AFlatOrInvertedCellIsNamedWithItsPlace) {
  for (const double where : {1.0, 1.4}) {
    auto mesh = cube({0, 0, 0});
    for (auto& x : mesh.nodes)
      if ((x - Point(0.5, 0.5, 0.5)).norm() < 1e-12) x = Point(where, 0.5, 0.5);
    const auto text = refusal(verification::write(mesh));
    expect_words(text,
                 {"inverted or degenerate cell in volume 7 (number ", ") near (", ") m", "refine the mesh"});
  }
}

}  // namespace
