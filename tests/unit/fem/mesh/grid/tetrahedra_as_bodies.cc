// Quadratic tetrahedra from the mesh to the responses.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "fem/base/values/constants.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "fem/stress/cells/cell_stress_at_node.h"
#include "fem/stress/cells/tetrahedra_error.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

using fem_tests::Point;
using Component = fem::SurfaceResultant::Component;
using fem::pi;

fem::Body steel_body(const std::shared_ptr<const fem::CoarseMesh>& cells) {
  fem::Body body;
  body.mesh = cells;
  body.material = {206e9, 0.3, 7850};
  return body;
}

std::string refusal(const fem::Body& body) {
  try {
    fem::make_grid(body);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

/// Of a cube's mesh with something changed.
std::string refusal(const std::function<void(fem::CoarseMesh&)>& change) {
  auto mesh = *fem_tests::cells_of(fem_tests::tetrahedra_cube(1, [](const Point& x) { return x; }));
  change(mesh);
  return refusal(steel_body(std::make_shared<const fem::CoarseMesh>(std::move(mesh))));
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

const auto bent = [](const Point& x) { return Point(x[0] + 0.1 * x[1] * x[2], x[1], 3 * x[2]); };

// The cube below shows two of the four faces only.
TEST(TetrahedraFaces, PointOutwardsWithMiddlesBetweenCorners) {
  const auto at = fem::nodes_in_cell({fem::CellKind::tetrahedra, 2}).point;
  const auto x = [&](int node) { return Point(at[node][0], at[node][1], at[node][2]); };
  for (int f = 0; f < 4; ++f) {
    const auto face = fem::face_nodes({fem::CellKind::tetrahedra, 2}, f);
    ASSERT_EQ(face.size(), 6u);
    const Point normal = (x(face[1]) - x(face[0])).cross(x(face[2]) - x(face[0]));
    EXPECT_LT(normal.dot(x(f) - x(face[0])), 0);  // away from the opposite corner
    for (int e = 0; e < 3; ++e) EXPECT_EQ((2 * x(face[3 + e]) - x(face[e]) - x(face[(e + 1) % 3])).norm(), 0);
  }
}

TEST(TetrahedraMesh, ComesBackAsItWas) {
  const auto written = fem_tests::tetrahedra_cube(2, bent);
  const auto read = fem::make_grid(steel_body(fem_tests::cells_of(written)));
  EXPECT_EQ(read.kind, fem::CellKind::tetrahedra);
  EXPECT_EQ(read.xyz_m, written.xyz_m);
  EXPECT_EQ(read.cell_nodes, written.cell_nodes);
  EXPECT_EQ(read.volume_id, written.volume_id);
  ASSERT_EQ(read.boundary.size(), written.boundary.size());
  for (std::size_t f = 0; f < read.boundary.size(); ++f) {
    EXPECT_EQ(read.boundary[f].cell, written.boundary[f].cell);
    EXPECT_EQ(read.boundary[f].face, written.boundary[f].face);
    EXPECT_EQ(read.boundary[f].boundary_id, written.boundary[f].boundary_id);
  }
}

TEST(TetrahedraMesh, IsRefusedInWords) {
  EXPECT_EQ(refusal([](auto&) {}), "accepted");
  expect_words(refusal([](auto& m) { m = {}; }), {"no cells"});
  expect_words(refusal([](auto& m) { m.cells.pop_back(); }), {"lengths do not fit"});
  expect_words(refusal([](auto& m) { m.face_id.pop_back(); }), {"lengths do not fit"});
  expect_words(refusal([](auto& m) { m.cells[7] = int(m.points_m.size()); }), {"names the node 28 of 28"});
  expect_words(refusal([](auto& m) { m.faces[2] = -1; }), {"names the node -1"});
  expect_words(refusal([](auto& m) { m.points_m[5][1] = std::nan(""); }), {"not finite"});
  expect_words(refusal([](auto& m) { m.volume_id[0] = -2; }), {"negative id"});
  expect_words(refusal([](auto& m) {
                 m.faces.resize(m.faces.size() - 6);
                 m.face_id.pop_back();
               }),
               {"surface near", "in a group"});
  expect_words(refusal([](auto& m) {
                 for (auto& x : m.points_m) x[0] = -x[0];
               }),
               {"inverted", "volume 7"});

  const auto cells = fem_tests::cells_of(fem_tests::tetrahedra_cube(1, bent));
  auto body = steel_body(cells);
  body.degree = 3;
  expect_words(refusal(body), {"degree = 3", "must be 2"});
  body = steel_body(cells);
  body.cylinders.emplace_back();
  expect_words(refusal(body), {"charts are for hexahedra"});
  body = steel_body(cells);
  body.refinements.push_back({{0}});
  expect_words(refusal(body), {"only hexahedra are refined"});
  expect_words(refusal(steel_body(nullptr)), {"no mesh"});
}

// The surface's nodes lie on the sphere; parabolas between them leave its volume to the order 4.
TEST(TetrahedraMass, OfABallConvergesWithTheOrderOfTheMap) {
  const auto ball = [](const Point& x) {
    const Point c = 2 * x - Point(1, 1, 1), s = c.cwiseAbs2();
    const auto one = [&](int a, int b, int d) {
      return c[a] * std::sqrt(1 - s[b] / 2 - s[d] / 2 + s[b] * s[d] / 3);
    };
    return Point(one(0, 1, 2), one(1, 0, 2), one(2, 0, 1));
  };
  const auto error = [&](int n) {
    const auto grid = fem_tests::tetrahedra_cube(n, ball);
    const auto mass = fem::mass_properties(
        grid, fem::integrate_nodes(grid, fem::colour_cells(grid, fem::cells_of_nodes(grid))), 3);
    EXPECT_NEAR(mass.first_moment_kg_m[0], 0, 1e-12);
    return std::array<double, 2>{mass.mass_kg / (4 * pi) - 1,
                                 mass.second_moments_kg_m2[0] / (4 * pi / 5) - 1};
  };
  const auto coarse = error(4), fine = error(8);
  for (int k = 0; k < 2; ++k) {
    EXPECT_GT(std::log2(coarse[k] / fine[k]), 3.5) << coarse[k] << " " << fine[k];
    EXPECT_LT(std::abs(fine[k]), 1e-3);
  }
}

/// A bar of 1 x 1 x 3 m under moments and forces at its ends.
struct Bar : testing::Test {
  static constexpr std::array<Component, 4> components = {Component::fz, Component::mx, Component::my,
                                                          Component::torque};
  void SetUp() override {
    const auto body = steel_body(fem_tests::cells_of(fem_tests::tetrahedra_cube(
        3, [](const Point& x) { return Point(x[0] - 0.5, x[1] - 0.5, 3 * x[2]); })));
    std::vector<fem::UnitLoad> loads;
    for (int end = 0; end < 2; ++end)
      for (const auto c : components) {
        fem::LoadSurface surface;
        surface.kind = fem::LoadSurface::Kind::face;
        surface.boundary_id = 5 + end;
        surface.centre_m = {0, 0, 3.0 * end};
        surface.radius_m = 0.5;
        loads.push_back(
            {"end_" + std::to_string(end) + "." + std::to_string(int(c)), fem::SurfaceResultant{surface, c}});
      }
    responses = fem::Model(body).unit_responses(loads, {});
  }
  /// Component k of the stress at a node, +1 of a load at the upper end and -1 at the lower one.
  double stress(std::size_t node, std::size_t load, int k) const {
    return responses.stress_Pa[(node * 8 + 4 + load) * 6 + k] -
           responses.stress_Pa[(node * 8 + load) * 6 + k];
  }
  fem::UnitResponses responses;
};

// Tension and bending are linear and quadratic displacements: exact.
TEST_F(Bar, HasTheStressOfBeams) {
  EXPECT_EQ(responses.nodes.kind, fem::CellKind::tetrahedra);
  EXPECT_LT(responses.residual, 1e-9);
  EXPECT_LT(responses.support_reaction, 1e-8);
  for (std::size_t i = 0; i < responses.nodes.n; ++i) {
    const double *x = &responses.nodes.xyz_m[3 * i], tolerance = 1e-7;  // of 6 Pa
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR(stress(i, 0, k), k == 2 ? 1 : 0, tolerance);
      EXPECT_NEAR(stress(i, 1, k), k == 2 ? 12 * x[1] : 0, tolerance);
      EXPECT_NEAR(stress(i, 2, k), k == 2 ? -12 * x[0] : 0, tolerance);
    }
  }
}

TEST_F(Bar, CellsAgreeWhereStressIsLinear) {
  const fem::Material material{206e9, 0.3, 7850};
  for (const std::size_t node : {std::size_t(0), responses.nodes.n / 2, responses.nodes.n - 1}) {
    const auto cells = fem::cell_stress_at_node_Pa(responses, material, node);
    ASSERT_FALSE(cells.empty());
    for (const auto& cell : cells)
      for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(cell[5][k] - cell[1][k], stress(node, 1, k), 1e-7) << node << " " << k;
  }
}

// Quadratic displacement: cells and recovery both have its stress. With one node moved they no longer agree
// in the cells around it, and at once everywhere else.
TEST_F(Bar, CellsAndRecoveredStressAgreeWhereItIsLinear) {
  const fem::Material material{206e9, 0.3, 7850};
  std::vector<double> factors(responses.channels.size(), 0.0);
  factors[5] = 1;
  factors[1] = -1;
  const auto corner = std::size_t(responses.nodes.cell(0)[0]),
             middle = std::size_t(responses.nodes.cell(0)[4]);
  for (const std::size_t node : {corner, middle}) {
    const auto agreed = fem::cells_against_recovered(responses, material, node, factors);
    EXPECT_LT(agreed.difference_Pa, 1e-7);  // of 6 Pa
  }
  auto moved = responses;
  const double before = fem::cells_against_recovered(moved, material, middle, factors).recovered_Pa;
  moved.displacement_m[(middle * moved.channels.size() + 5) * 3 + 2] += 1e-12;
  const auto off = fem::cells_against_recovered(moved, material, middle, factors);
  EXPECT_EQ(off.recovered_Pa, before);
  EXPECT_GT(off.difference_Pa, 1e-3);
  EXPECT_THROW(fem::cells_against_recovered(responses, material, responses.nodes.n, factors),
               std::invalid_argument);
  EXPECT_THROW(fem::cells_against_recovered(responses, material, 0, {1.0}), std::invalid_argument);
}

// The cell fields and volumes that pipelines takes.
TEST_F(Bar, NodesAreInVtkOrder) {
  const auto& nodes = responses.nodes;
  const auto x = [&](std::int32_t i) { return Eigen::Map<const Point>(&nodes.xyz_m[3 * i]); };
  ASSERT_EQ(nodes.n_cells(), 6u * 27);
  ASSERT_EQ(nodes.n_faces(), 6u * 18);
  ASSERT_EQ(nodes.face_boundary_id.size(), nodes.n_faces());
  constexpr int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  double volume = 0;
  for (const double v : nodes.volume_m3) volume += v;
  EXPECT_NEAR(volume, 3, 1e-12);
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    EXPECT_GT((x(cell[1]) - x(cell[0])).cross(x(cell[2]) - x(cell[0])).dot(x(cell[3]) - x(cell[0])), 0);
    for (int e = 0; e < 6; ++e)
      EXPECT_LT((2 * x(cell[4 + e]) - x(cell[edges[e][0]]) - x(cell[edges[e][1]])).norm(), 1e-14);
  }
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    const Point normal = (x(face[1]) - x(face[0])).cross(x(face[2]) - x(face[0]));
    EXPECT_GT(normal.dot(x(face[0]) - Point(0, 0, 1.5)), 0);
    for (int e = 0; e < 3; ++e)
      EXPECT_LT((2 * x(face[3 + e]) - x(face[e]) - x(face[(e + 1) % 3])).norm(), 1e-14);
  }
}

}  // namespace
