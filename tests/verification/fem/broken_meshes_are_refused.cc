// Meshes that no solver should see: in pieces, hinged, with cells that are flat or inside out. The message
// names the cell or the pieces, a place, and what to do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "fem/base/values/body_nodes.h"
#include "tests/unit/fem/examples/tetrahedra.h"
#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

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

std::string refusal(const verification::Cells& cells,
                    const std::vector<fem::RefinementCycle>& refinements = {}) {
  fem::Body body;
  body.mesh = cells;
  body.refinements = refinements;
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
      refusal(verification::cells_of(together(cube({0, 0, 0}), cube({3, 0, 0}), true))),
      {"2 pieces", "8 cells near (0.25, 0.25, 0.25) m", "8 cells near (3.25, 0.25, 0.25) m", "join them"});
}

// On a refined mesh faces of large and small cells match nowhere: pieces are looked for before cells are cut.
TEST(BrokenMesh, InTwoPiecesThatAreRefined) {
  const auto cells = verification::cells_of(together(cube({0, 0, 0}), cube({3, 0, 0}), true));
  expect_words(refusal(cells, {{{0}}}),
               {"2 pieces", "8 cells near (0.25, 0.25, 0.25) m", "8 cells near (3.25, 0.25, 0.25) m"});
  fem::Body body;
  body.mesh = cells;
  body.material = {200e9, 0.3, 7850};
  EXPECT_THROW(fem::body_nodes(body), fem::MeshUnusable);
}

// What a mesher leaves of two solids that were never fragmented: they touch, and share no node.
TEST(BrokenMesh, SideBySideWithoutCommonNodes) {
  expect_words(refusal(verification::cells_of(together(cube({0, 0, 0}), cube({1, 0, 0}), false))),
               {"2 pieces"});
}

TEST(BrokenMesh, HingedAtAnEdgeOrACorner) {
  expect_words(refusal(verification::cells_of(together(cube({0, 0, 0}), cube({1, 1, 0}), true))),
               {"2 pieces that share no face"});
  expect_words(refusal(verification::cells_of(together(cube({0, 0, 0}), cube({1, 1, 1}), true))),
               {"2 pieces"});
}

TEST(BrokenMesh, ManyPiecesAreCountedAndTheLargestNamed) {
  auto mesh = cube({0, 0, 0});
  for (int k = 1; k < 8; ++k) {
    verification::Block one;
    one.map = [k](const Point& c) { return Point(c + Point(0, 0, 4 * k)); };
    mesh = together(std::move(mesh), verification::hexahedra(one), true);
  }
  expect_words(refusal(verification::cells_of(mesh)), {"8 pieces", ": 8 cells near (0.25, 0.25, 0.25) m",
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
  expect_words(refusal(fem_tests::cells_of(grid)), {"2 pieces", "6 cells near", "in volume 7"});
}

// What deal.II would read out of bounds, or not join.
TEST(BrokenMesh, ArraysThatAreNoMesh) {
  const auto changed = [](const std::function<void(fem::CoarseMesh&)>& change) {
    auto mesh = *verification::cells_of(cube({0, 0, 0}));
    change(mesh);
    return refusal(std::make_shared<const fem::CoarseMesh>(std::move(mesh)));
  };
  EXPECT_EQ(changed([](auto&) {}), "accepted");
  expect_words(changed([](auto& m) { m = {}; }), {"no cells"});
  expect_words(changed([](auto& m) { m.cells.pop_back(); }), {"lengths do not fit"});
  expect_words(changed([](auto& m) { m.faces.push_back(0); }), {"lengths do not fit"});
  expect_words(changed([](auto& m) { m.cells[3] = 27; }), {"names the node 27 of 27"});
  expect_words(changed([](auto& m) { m.faces[3] = -1; }), {"names the node -1"});
  expect_words(changed([](auto& m) { m.points_m[3][2] = INFINITY; }), {"not finite"});
  expect_words(changed([](auto& m) { m.face_id[0] = -1; }), {"negative id"});
  expect_words(changed([](auto& m) {  // a face of the boundary that lies inside
                 const int inside[] = {1, 4, 13, 10};
                 m.faces.insert(m.faces.end(), inside, inside + 4);
                 m.face_id.push_back(9);
               }),
               {"cannot be joined"});
}

TEST(BrokenMesh, JoinedCubesAreOnePiece) {
  EXPECT_EQ(refusal(verification::cells_of(together(cube({0, 0, 0}), cube({1, 0, 0}), true))), "accepted");
}

// The middle node of the cube, cell after cell: flat, then beyond the opposite corner.
TEST(BrokenMesh, AFlatOrInvertedCellIsNamedWithItsPlace) {
  for (const double where : {1.0, 1.4}) {
    auto mesh = cube({0, 0, 0});
    for (auto& x : mesh.nodes)
      if ((x - Point(0.5, 0.5, 0.5)).norm() < 1e-12) x = Point(where, 0.5, 0.5);
    const auto text = refusal(verification::cells_of(mesh));
    expect_words(text,
                 {"inverted or degenerate cell in volume 7 (number ", ") near (", ") m", "refine the mesh"});
  }
}

}  // namespace
