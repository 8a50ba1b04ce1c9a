// Submodels against displacements that are exact in all of the body: what the cells of the body get wrong is
// then known, and so is what finer cells have to find.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "fem/equations/operators/nodes_export.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/refine/submodel/cut_cells.h"
#include "fem/refine/submodel/submodel.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

using fem_tests::Point;
using Displacement = std::function<Point(const Point&)>;

constexpr fem::Material submodel_steel{200e9, 0.3, 7850};
constexpr double g_m_s2 = 9.81;

const auto not_bent = [](const Point& x) { return x; };
const auto bent = [](const Point& x) {
  return Point(x[0] + 0.05 * std::sin(3 * x[1]), x[1] + 0.05 * std::sin(2 * x[2] + x[0]),
               x[2] + 0.04 * x[0] * x[1]);
};

/// n^3 cells of the unit cube, all nodes moved by `bend`; groups as tetrahedra_cube.
fem::Grid hexahedra_cube(int n, const std::function<Point(const Point&)>& bend) {
  fem::Grid grid;
  const int m = 2 * n + 1;  // nodes along an edge
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) {
        const Point x = bend(Point(i, j, k) / (m - 1));
        grid.xyz_m.insert(grid.xyz_m.end(), x.data(), x.data() + 3);
      }
  grid.n_nodes = grid.xyz_m.size() / 3;
  for (int c = 0; c < n * n * n; ++c) {
    const std::array<int, 3> at = {c % n, c / n % n, c / n / n};
    for (int v = 0; v < 27; ++v)
      grid.cell_nodes.push_back(2 * at[0] + v % 3 + m * (2 * at[1] + v / 3 % 3 + m * (2 * at[2] + v / 9)));
    grid.volume_id.push_back(7);
    for (int face = 0; face < 6; ++face)
      if (at[std::size_t(face / 2)] == (face % 2 == 0 ? 0 : n - 1))
        grid.boundary.push_back({c, face, face + 1});
  }
  return grid;
}

fem::Body of_steel() {
  fem::Body body;
  body.material = submodel_steel;
  return body;
}

/// A body that moves by u, under one load.
fem::UnitResponses responses_of(const fem::Grid& grid, const Displacement& u) {
  fem::UnitResponses responses;
  responses.channels = {"load"};
  responses.nodes = fem::export_nodes(grid);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const Point at = u(Point(grid.position(std::int32_t(i))));
    responses.displacement_m.insert(responses.displacement_m.end(), at.data(), at.data() + 3);
  }
  return responses;
}

/// The node nearest to a point.
std::size_t node_at(const fem::Grid& grid, const Point& wanted) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    if ((Point(grid.position(std::int32_t(i))) - wanted).norm() <
        (Point(grid.position(std::int32_t(nearest))) - wanted).norm())
      nearest = i;
  return nearest;
}

/// Holds all of one boundary group, as a load on it does.
fem::UnitLoad load_on(int boundary_id) {
  fem::LoadSurface surface;
  surface.kind = fem::LoadSurface::Kind::face;
  surface.boundary_id = boundary_id;
  return {"load", fem::SurfaceResultant{surface, fem::SurfaceResultant::Component::fz}};
}

constexpr int nowhere = 99;  // no face has this group

const fem::UnitLoad weight = {"load", fem::BodyForce{fem::BodyForce::Field::translation_z, {}}};

double area_of_groups(const fem::Grid& grid, int id) {
  const auto points = fem::gauss_on_face(grid.shape(), 5);
  double area = 0;
  for (const auto& face : grid.boundary)
    if (face.boundary_id == id)
      for (int q = 0; q < points.n_points; ++q)
        area += fem::face_point(grid, fem::nodes_of_face(grid, std::size_t(face.cell), face.face), points, q)
                    .area.norm();
  return area;
}

void expect_same_shape(const fem::Grid& grid) {
  fem::GridField coarse{grid, {}};
  coarse.field.setZero(Eigen::Index(grid.n_nodes), 1);
  const auto fine = fem::cut_into_eight(coarse);
  ASSERT_EQ(fine.grid.n_cells(), 8 * grid.n_cells());
  fem::refuse_inverted_cells(fine.grid);
  const auto volume = [](const fem::Grid& of) {
    return fem::integrate_nodes(of, std::vector<int>{7}).col(0).sum();
  };
  EXPECT_NEAR(volume(fine.grid), volume(grid), 1e-13);
  for (int id = 1; id <= 6; ++id)  // Gauss points of order 9 on roots of polynomials: not exact
    EXPECT_NEAR(area_of_groups(fine.grid, id), area_of_groups(grid, id), 1e-6) << id;
  EXPECT_EQ(fine.grid.boundary.size(), 4 * grid.boundary.size());
}

void expect_quadratic_fields_stay(const fem::Grid& grid) {
  const auto field = [](const double* x) { return 1 + x[0] * x[1] - 2 * x[2] * x[2] + x[1]; };
  fem::GridField coarse{grid, {}};
  coarse.field.resize(Eigen::Index(grid.n_nodes), 1);
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    coarse.field(Eigen::Index(i), 0) = field(grid.position(std::int32_t(i)));
  const auto fine = fem::cut_into_eight(fem::cut_into_eight(coarse));
  ASSERT_EQ(fine.grid.n_cells(), 64 * grid.n_cells());
  for (std::size_t i = 0; i < fine.grid.n_nodes; ++i)
    EXPECT_NEAR(fine.field(Eigen::Index(i), 0), field(fine.grid.position(std::int32_t(i))), 1e-13);
}

TEST(CutCells, KeepShapeAndSurface) {
  expect_same_shape(fem_tests::tetrahedra_cube(2, bent));
  expect_same_shape(hexahedra_cube(2, bent));
}

TEST(CutCells, QuadraticFieldsStayOnStraightCells) {
  expect_quadratic_fields_stay(fem_tests::irregular_cube(2));
  expect_quadratic_fields_stay(hexahedra_cube(2, not_bent));
}

// Cells share the nodes between them: a conforming mesh of n^3 cells has (2 n + 1)^3 nodes.
TEST(CutCells, NeighboursShareTheirNodes) {
  fem::GridField coarse{hexahedra_cube(2, bent), {}};
  coarse.field.setZero(Eigen::Index(coarse.grid.n_nodes), 1);
  EXPECT_EQ(fem::cut_into_eight(coarse).grid.n_nodes, 9u * 9u * 9u);
}

// A column hung up at z = 1: stress rho g z along z, all quadratic. Its sides are free.
void expect_weight_acts(const fem::Grid& grid) {
  // For an acceleration of 1 m/s2 upwards; gravity is -g of that.
  const double a = -submodel_steel.density_kg_m3 / submodel_steel.youngs_modulus_Pa,
               nu = submodel_steel.poisson_ratio;
  const auto responses = responses_of(grid, [&](const Point& x) {
    return Point(-nu * a * x[0] * x[2], -nu * a * x[1] * x[2],
                 a / 2 * (x[2] * x[2] + nu * (x[0] * x[0] + x[1] * x[1])));
  });
  const auto node = node_at(grid, {0, 0.4, 0.4});
  const double known_Pa = submodel_steel.density_kg_m3 * g_m_s2 * 0.4;
  const auto found = fem::submodel_stress(responses, of_steel(), {weight}, {{node}}, {-g_m_s2}, {}, {2, 1});
  EXPECT_NEAR(found.at_point_Pa, known_Pa, 1e-9 * known_Pa);
  EXPECT_NEAR(found.largest_Pa, known_Pa / 0.4 * 0.6, 1e-9 * known_Pa);  // one cell of 0.2 higher
  const auto weightless =
      fem::submodel_stress(responses, of_steel(), {load_on(nowhere)}, {{node}}, {-g_m_s2}, {}, {2, 1});
  EXPECT_GT(std::abs(weightless.at_point_Pa - known_Pa), 0.01 * known_Pa);
}

TEST(Submodel, BodyForcesAct) {
  expect_weight_acts(fem_tests::tetrahedra_cube(5, not_bent));
  expect_weight_acts(hexahedra_cube(5, not_bent));
}

// Two channels, the column's weight and a uniform pull along z, at a point of two nodes as weld toes have.
TEST(Submodel, UnitStressesAreThoseOfTheChannels) {
  const auto grid = hexahedra_cube(7, not_bent);
  const double a = -submodel_steel.density_kg_m3 / submodel_steel.youngs_modulus_Pa,
               nu = submodel_steel.poisson_ratio;
  const auto hung = responses_of(grid, [&](const Point& x) {
    return Point(-nu * a * x[0] * x[2], -nu * a * x[1] * x[2],
                 a / 2 * (x[2] * x[2] + nu * (x[0] * x[0] + x[1] * x[1])));
  });
  const auto pulled = responses_of(grid, [&](const Point& x) { return Point(-nu * x[0], -nu * x[1], x[2]); });
  auto both = hung;
  both.channels = {"weight", "pull"};
  both.displacement_m.clear();
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    for (const auto* of : {&hung, &pulled})
      both.displacement_m.insert(both.displacement_m.end(), &of->displacement_m[3 * i],
                                 &of->displacement_m[3 * i] + 3);
  auto pull = load_on(nowhere);
  pull.channel = "pull";
  const auto near = node_at(grid, {0, 3. / 7, 3. / 7}), far = node_at(grid, {0, 3. / 7, 4. / 7});
  const auto unit =
      fem::submodel_unit_stress_Pa(both, of_steel(), {weight, pull}, {{near, 1.67}, {far, -0.67}}, {2, 1});
  ASSERT_EQ(unit.size(), 2u);
  const double density = submodel_steel.density_kg_m3, modulus_Pa = submodel_steel.youngs_modulus_Pa;
  EXPECT_NEAR(unit[0][2], -density * (1.67 * 3 - 0.67 * 4) / 7, 1e-8 * density);
  EXPECT_NEAR(unit[1][2], modulus_Pa, 1e-9 * modulus_Pa);
  for (const int c : {0, 1, 3, 4, 5}) {
    EXPECT_NEAR(unit[0][std::size_t(c)], 0, 1e-8 * density);
    EXPECT_NEAR(unit[1][std::size_t(c)], 0, 1e-8 * modulus_Pa);
  }
}

// Stress is the same everywhere, and does not vanish on the face x = 0: that is held, as loaded ones are.
TEST(Submodel, LoadedFacesAreHeld) {
  const auto grid = fem_tests::tetrahedra_cube(
      5, [](const Point& x) { return Point(x[0] + 0.05 * std::sin(3 * x[1]), x[1], x[2]); });
  const auto responses =
      responses_of(grid, [](const Point& x) { return Point(2e-4 * x[0], -0.6e-4 * x[1], -0.6e-4 * x[2]); });
  const auto node = node_at(grid, {0.05 * std::sin(1.2), 0.4, 0.4});
  const double known_Pa = 200e9 * 2e-4;  // uniaxial: the lateral strain is nu times the axial one
  const auto stress_Pa = [&](int loaded) {
    return fem::submodel_stress(responses, of_steel(), {load_on(loaded)}, {{node}}, {1}, {}, {2, 1})
        .at_point_Pa;
  };
  EXPECT_NEAR(stress_Pa(1), known_Pa, 1e-8 * known_Pa);
  EXPECT_GT(std::abs(stress_Pa(nowhere) - known_Pa), 0.05 * known_Pa);
}

// A pull along z, whose displacement the body has wrong on the loaded face and beside it. Held there, a
// submodel keeps what is wrong; under the traction of its share of the face it finds what is true up to what
// the rim holds.
TEST(Submodel, LoadedFacesFindTheirDisplacement) {
  const auto grid = fem_tests::tetrahedra_cube(5, [](const Point& x) { return x; });
  const double strain = 1 / submodel_steel.youngs_modulus_Pa, known_Pa = 40e6;  // by 1 N on 1 m2
  const auto responses = responses_of(grid, [&](const Point& x) {
    const double wrong = x[2] > 0.85 ? 0.3 * std::sin(40 * x[0]) * std::sin(40 * x[1]) * (x[2] - 0.85) : 0;
    return Point(-0.3 * strain * x[0], -0.3 * strain * x[1], strain * (x[2] + wrong));
  });
  auto pull = load_on(6);
  auto& surface = std::get<fem::SurfaceResultant>(pull.shape).surface;
  surface.centre_m = {0.5, 0.5, 1};
  const auto node = node_at(grid, {0, 0.4, 1});
  const auto stress_Pa = [&](fem::LoadedFaces faces) {
    return fem::submodel_stress(responses, of_steel(), {pull}, {{node}}, {known_Pa}, {}, {2, 1, faces})
        .at_point_Pa;
  };
  EXPECT_NEAR(stress_Pa(fem::LoadedFaces::loaded), known_Pa, 0.005 * known_Pa);
  EXPECT_GT(std::abs(stress_Pa(fem::LoadedFaces::held) - known_Pa), 0.02 * known_Pa);
}

TEST(Submodel, KnowsWhatIsOnALoadAndBesideASupport) {
  const auto grid = hexahedra_cube(5, not_bent);
  const auto responses = responses_of(grid, [](const Point& x) { return x; });
  const auto point = [&](double z) {
    return std::vector<fem::WeightedNode>{{node_at(grid, {0, 0.4, 0.4})}, {node_at(grid, {0, 0.4, z})}};
  };
  EXPECT_TRUE(fem::is_on_load(responses, of_steel(), {load_on(6)}, point(1)));
  EXPECT_FALSE(fem::is_on_load(responses, of_steel(), {load_on(6)}, point(0.8)));
  EXPECT_FALSE(fem::is_beside_support(responses, of_steel(), point(1)));
  auto clamped = of_steel();
  fem::Clamp clamp;
  clamp.boundary_id = 6;
  clamped.clamps.push_back(clamp);
  const auto is_beside = [&](double z) { return fem::is_beside_support(responses, clamped, point(z)); };
  EXPECT_TRUE(is_beside(1));
  EXPECT_TRUE(is_beside(0.8));  // its cells reach to the clamp
  EXPECT_FALSE(is_beside(0.6));
}

// The gradient of a harmonic function loads no cell. Its interpolant on the coarse cells is the rim of the
// submodel: only the inside gets better.
TEST(Submodel, FinerCellsComeNearerToTheTruth) {
  const auto grid = fem_tests::irregular_cube(6);
  const auto responses = responses_of(grid, [](const Point& x) {
    const double s = std::exp(6 * x[0]);
    return Point(1e-6 * s * std::sin(6 * x[1]), 1e-6 * s * std::cos(6 * x[1]), 0);
  });
  const auto node = node_at(grid, {0.5, 0.5, 0.5});
  const Point x(grid.position(std::int32_t(node)));
  // Gradient 6e-6 exp(6x) (sin, cos; cos, -sin): a pure shear of that size.
  const double known_Pa = std::sqrt(3.0) * 2 * 200e9 / 2.6 * 6e-6 * std::exp(6 * x[0]);
  const auto off_Pa = [&](int n_layers, int n_cuts) {
    return std::abs(
        fem::submodel_stress(responses, of_steel(), {load_on(nowhere)}, {{node}}, {1}, {}, {n_layers, n_cuts})
            .at_point_Pa -
        known_Pa);
  };
  const double coarse_Pa = off_Pa(2, 0), once_Pa = off_Pa(2, 1), twice_Pa = off_Pa(2, 2);
  EXPECT_LT(once_Pa, coarse_Pa / 3);
  EXPECT_LT(twice_Pa, 0.01 * known_Pa);
}

TEST(Submodel, PlacesLeftOutAreNotSearched) {
  const auto grid = fem_tests::tetrahedra_cube(6, not_bent);
  // Bending about y: stress grows with x, so that the largest value lies at the far end of the cells.
  const auto responses = responses_of(grid, [](const Point& x) {
    return Point(0.3e-3 * (x[1] * x[1] - x[0] * x[0]) / 2 - 1e-3 * x[2] * x[2] / 2, -0.3e-3 * x[0] * x[1],
                 1e-3 * x[0] * x[2]);
  });
  const auto node = node_at(grid, {0.5, 0, 0.5});
  const auto free =
      fem::submodel_stress(responses, of_steel(), {load_on(nowhere)}, {{node}}, {1}, {}, {2, 1});
  EXPECT_NEAR(free.at_point_Pa, 200e9 * 1e-3 * 0.5, 1e3);
  EXPECT_NEAR(free.largest_Pa, 200e9 * 1e-3 * 2 / 3, 1e3);
  // Cells are cut once: their nodes have a quarter of their length between them.
  const auto beyond = [](const std::array<double, 3>& x, int) { return x[0] > 0.6; };
  EXPECT_NEAR(fem::submodel_stress(responses, of_steel(), {load_on(nowhere)}, {{node}}, {1}, beyond, {2, 1})
                  .largest_Pa,
              200e9 * 1e-3 * (0.5 + 0.5 / 6), 1e3);
}

TEST(Submodel, RefusesWhatIsNoneOfItsBusiness) {
  const auto grid = fem_tests::tetrahedra_cube(2, not_bent);
  auto responses = responses_of(grid, [](const Point& x) { return x; });
  EXPECT_THROW(fem::submodel_stress(responses, of_steel(), {weight}, {{0}}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(fem::submodel_stress(responses, of_steel(), {}, {{0}}, {1}), std::invalid_argument);
  EXPECT_THROW(fem::submodel_stress(responses, of_steel(), {weight}, {{grid.n_nodes + 5}}, {1}),
               std::invalid_argument);
  responses.nodes.degree = 3;
  EXPECT_THROW(fem::submodel_stress(responses, of_steel(), {weight}, {{0}}, {1}), std::invalid_argument);
}

}  // namespace
