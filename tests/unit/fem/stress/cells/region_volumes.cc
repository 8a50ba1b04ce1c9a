// The volume of the part of a body above a level: closed forms on cells of every kind, straight and curved.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "fem/base/values/body_nodes.h"
#include "fem/base/values/constants.h"
#include "fem/equations/operators/nodes_export.h"
#include "fem/models/solid/model.h"
#include "fem/stress/cells/region_volume.h"
#include "meshes/keyed_shaft/solid_shaft.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

using Field = std::function<double(const double*)>;
using fem::pi;

std::vector<double> at_nodes(const fem::Nodes& nodes, const Field& field) {
  std::vector<double> values;
  for (std::size_t i = 0; i < nodes.n; ++i) values.push_back(field(&nodes.xyz_m[3 * i]));
  return values;
}

double above(const fem::Nodes& nodes, const std::vector<double>& values, double level) {
  const auto volumes = fem::cell_volumes_above_m3(nodes, values, level, std::vector<char>(nodes.n, 0));
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

constexpr double rod_radius = 0.025, rod_length = 0.1;

meshes::Shaft round_rod() {
  meshes::Shaft shaft;
  shaft.segments = {{"rod", 0, rod_length, 2 * rod_radius, 0, true, 0, 0, ""}};
  return shaft;
}

fem::Body hexahedra(int degree) {
  auto body = fem_tests::build(round_rod(), {}).body;
  body.degree = degree;
  return body;
}

struct Tetrahedra {
  fem::Body body;
  meshes::BodyMesh mesh;
  Tetrahedra() {
    meshes::SolidControl control;
    control.size_m = 0.01;
    control.cells_per_circle = 12;
    mesh = meshes::build_solid_shaft(round_rod(), {}, control);
    body = fem_tests::steel_body(mesh);
  }
};

}  // namespace

// Of the unit tetrahedron the plane x = t leaves (1 - t)^3; a wedge by symmetry one half.
TEST(RegionVolume, OfOneTetrahedron) {
  EXPECT_EQ(fem::share_above_zero({1, 2, 3, 4}), 1);
  EXPECT_EQ(fem::share_above_zero({-1, -2, -3, -4}), 0);
  EXPECT_EQ(fem::share_above_zero({0, -1, -1, -1}), 0);
  for (const double t : {0.1, 0.5, 0.9}) {
    EXPECT_NEAR(fem::share_above_zero({-t, 1 - t, -t, -t}), std::pow(1 - t, 3), 1e-15);
    EXPECT_NEAR(fem::share_above_zero({t, t - 1, t, t}), 1 - std::pow(1 - t, 3), 1e-15);
  }
  EXPECT_NEAR(fem::share_above_zero({1, -1, 1, -1}), 0.5, 1e-15);
  EXPECT_NEAR(fem::share_above_zero({3, 2, -2, -3}), 0.5, 1e-15);
  // Just beside a node the formulas meet.
  EXPECT_NEAR(fem::share_above_zero({2, 1e-12, -1, -3}), fem::share_above_zero({2, -1e-12, -1, -3}), 1e-11);
}

// What is linear in x is linear between the nodes of straight cells: exact to rounding.
TEST(RegionVolume, OfALinearFieldIsExactOnStraightCells) {
  const auto nodes = fem::export_nodes(fem_tests::irregular_cube(3));
  const auto values = at_nodes(nodes, [](const double* x) { return 2 * x[0]; });
  for (const double level : {0.0, 0.2, 0.66, 1.3, 2.1})
    EXPECT_NEAR(above(nodes, values, level), level > 2 ? 0 : 1 - level / 2, 1e-13);
}

// A triangle with two corners on the axis, turned: a hexahedron of which two edges are one piece of the axis,
// and two others are points. Its Jacobian vanishes at all eight corners.
TEST(RegionVolume, OfACellThatIsATetrahedron) {
  const std::array<std::array<double, 3>, 4> corners = {{{1, 0, 0.5}, {0, 1, 0.5}, {0, 0, 0}, {0, 0, 1}}};
  for (const double factor : {1.0, 0.3e-3}) {
    fem::Nodes nodes;
    nodes.degree = 1;
    nodes.n = 4;
    for (const auto& corner : corners)
      for (const double x : corner) nodes.xyz_m.push_back(factor * x);
    nodes.cells = {0, 2, 3, 0, 1, 2, 3, 1};
    const double whole = std::pow(factor, 3) / 6;
    EXPECT_NEAR(above(nodes, {1, 1, 1, 1}, 0), whole, 1e-12 * whole);
    for (const auto& values : {std::vector<double>{-1, -1, 0.5, -1}, {-1, -2, 3, 2}, {1, -3, 1, 1}}) {
      const double share = fem::share_above_zero({values[0], values[1], values[2], values[3]});
      EXPECT_NEAR(above(nodes, values, 0), share * whole, 1e-12 * whole);
    }
    for (const double v : fem::nodal_volumes_m3(nodes)) EXPECT_GT(v, 0);
  }
}

// Whatever the field: what is above a level in a cell is neither negative nor more than the cell, and with
// what is below it, the whole. Curved cells; a cell's volume by the nodes' integrals would be negative at its
// corners.
TEST(RegionVolume, IsPositiveAndComplete) {
  const Tetrahedra tetrahedra;
  std::vector<fem::Nodes> bodies = {fem::body_nodes(tetrahedra.body)};
  for (const int degree : {1, 2, 3}) bodies.push_back(fem::body_nodes(hexahedra(degree)));
  for (const auto& nodes : bodies) {
    const auto values = at_nodes(
        nodes, [](const double* x) { return std::sin(300 * x[0]) * std::cos(200 * x[2] + 90 * x[1]); });
    auto opposite = values;
    for (double& v : opposite) v = -v;
    const std::vector<char> none(nodes.n, 0);
    const auto whole = fem::cell_volumes_above_m3(nodes, values, -2, none),
               high = fem::cell_volumes_above_m3(nodes, values, 0.3, none),
               low = fem::cell_volumes_above_m3(nodes, opposite, -0.3, none);
    for (std::size_t c = 0; c < whole.size(); ++c) {
      EXPECT_GT(whole[c], 0);
      EXPECT_GE(high[c], 0);
      EXPECT_LE(high[c], whole[c] * (1 + 1e-12));
      EXPECT_NEAR(high[c] + low[c], whole[c], 1e-12 * whole[c]) << c;
    }
    double sum = 0;
    for (const double v : fem::nodal_volumes_m3(nodes)) {
      EXPECT_GT(v, 0);
      sum += v;
    }
    EXPECT_NEAR(sum, std::accumulate(whole.begin(), whole.end(), 0.0), 1e-12 * sum);
  }
}

// A small region off the middle has the volume of its mirror images: six tetrahedra around one diagonal of
// each box differ by 4 % with linear cells.
TEST(RegionVolume, DoesNotDependOnHowCellsAreTurned) {
  for (const int degree : {1, 2, 3}) {
    const auto nodes = fem::body_nodes(hexahedra(degree));
    std::vector<double> volumes;
    for (const double side : {1.0, -1.0})
      for (const double end : {1.0, -1.0}) {
        const auto values = at_nodes(nodes, [&](const double* x) {
          return -std::hypot(x[0] - 0.02, x[1] - side * 0.004, x[2] - rod_length / 2 - end * 0.018);
        });
        volumes.push_back(above(nodes, values, -0.011));
      }
    for (const double volume : volumes) EXPECT_NEAR(volume / volumes.front(), 1, 1e-9) << degree;
  }
}

// In torsion von Mises stress grows like r: 1 - s^2 of the volume is above the share s of the largest.
// Between nodes a circle is a polygon, which leaves (h / r)^2 / 12 of what it bounds, h between nodes: 3e-3
// for 24 nodes around.
TEST(RegionVolume, OfATwistedRod) {
  const Tetrahedra tetrahedra;
  for (const auto& body : {tetrahedra.body, hexahedra(2)}) {
    const auto nodes = fem::body_nodes(body);
    const auto values = at_nodes(nodes, [](const double* x) { return std::hypot(x[0], x[1]); });
    const double whole = pi * rod_radius * rod_radius * rod_length;
    EXPECT_NEAR(above(nodes, values, 0) / whole, 1, 2e-4);  // parabolas for the circle
    for (const double share : {0.3, 0.5, 0.8, 0.9})
      EXPECT_NEAR(above(nodes, values, share * rod_radius) / whole, 1 - share * share, 0.012) << share;
  }
}

// Curved between nodes the circle is one, and a parabola along the rod too: the difference from straight
// tells how far nodes are apart. Cells of degree 1 know the circle by the slopes at their nodes.
TEST(RegionVolume, OfAFieldThatIsCurvedBetweenNodes) {
  const Tetrahedra tetrahedra;
  const auto field = [](const double* x) {
    return 1 - (x[0] * x[0] + x[1] * x[1]) / (rod_radius * rod_radius);
  };
  for (const auto& body : {tetrahedra.body, hexahedra(1), hexahedra(2), hexahedra(3)}) {
    const auto nodes = fem::body_nodes(body);
    const auto values = at_nodes(nodes, field);
    const std::vector<char> none(nodes.n, 0);
    const auto all = fem::curved_cell_volumes_above_m3(nodes, values, -2, none);
    const double whole = std::accumulate(all.begin(), all.end(), 0.0);
    EXPECT_NEAR(whole, above(nodes, values, -2), 1e-12 * whole);
    for (const double level : {0.4, 0.6}) {
      const auto parts = fem::curved_cell_volumes_above_m3(nodes, values, level, none);
      const double curved = std::accumulate(parts.begin(), parts.end(), 0.0),
                   exact = pi * rod_radius * rod_radius * rod_length * (1 - level);
      EXPECT_LT(std::abs(curved - exact), 0.5 * std::abs(above(nodes, values, level) - exact))
          << body.degree << ' ' << level;
    }
  }
}

// The same of the stress that tetrahedra have in bending, from the mesher to the recovered stress: |y| / r
// above s leaves two segments of the circle.
TEST(RegionVolume, OfABentRodOfTetrahedra) {
  const Tetrahedra tetrahedra;
  std::vector<fem::UnitLoad> loads;
  for (const auto& port : tetrahedra.mesh.ports) {
    if (port.kind != meshes::Port::Kind::face) continue;
    fem::LoadSurface surface;
    surface.kind = fem::LoadSurface::Kind::face;
    surface.boundary_id = port.boundary_id;
    surface.centre_m = {port.axis_x_m, port.axis_y_m, port.begin_m};
    surface.radius_m = port.radius_m;
    loads.push_back({port.name, fem::SurfaceResultant{surface, fem::SurfaceResultant::Component::mx}});
  }
  ASSERT_EQ(loads.size(), 2u);
  const auto r = fem::Model(tetrahedra.body).unit_responses(loads, {});
  std::vector<double> values;
  for (std::size_t i = 0; i < r.nodes.n; ++i)
    values.push_back(std::abs(r.stress_Pa[(2 * i + 1) * 6 + 2] - r.stress_Pa[2 * i * 6 + 2]));
  const double largest = rod_radius / (pi * std::pow(rod_radius, 4) / 4),
               whole = pi * rod_radius * rod_radius * rod_length;
  for (const double share : {0.3, 0.5, 0.8}) {
    const double exact = 2 * (std::acos(share) - share * std::sqrt(1 - share * share)) / pi;
    // Polygons for the circle, and the nodal stress: off by up to 2 % of the largest, in the mean by less.
    EXPECT_NEAR(above(r.nodes, values, share * largest) / whole, exact, 0.012) << share;
  }
}
