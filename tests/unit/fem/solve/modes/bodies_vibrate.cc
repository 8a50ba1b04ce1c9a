// Natural frequencies of clamped and free bodies and of bodies on springs: shapes, counts, refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fem/base/values/body_nodes.h"
#include "fem/base/values/constants.h"
#include "fem/equations/operators/mass_matrix.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/reference_cell.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

using fem::pi;
constexpr double length_m = 0.2;

fem::MassMatrix mass_matrix(const fem::Grid& grid, double density_kg_m3) {
  const auto cells = fem::cells_of_nodes(grid);
  return fem::MassMatrix(grid, fem::colour_cells(grid, cells), fem::make_node_graph(grid, cells),
                         density_kg_m3);
}

Eigen::MatrixXd shapes(const std::vector<fem::NaturalMode>& modes) {
  Eigen::MatrixXd x(modes.front().shape.size(), modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i)
    x.col(i) = Eigen::Map<const Eigen::VectorXd>(modes[i].shape.data(), x.rows());
  return x;
}

struct Vibrations : testing::Test {
  static void SetUpTestSuite() {
    rod = new fem_tests::ShaftBody(fem_tests::rod(8));
    free_modes = new std::vector<fem::NaturalMode>(fem::Model(rod->body).natural_frequencies(8));
  }
  static void TearDownTestSuite() {
    delete free_modes;
    delete rod;
  }
  static fem::Body on_springs(const std::vector<std::string>& ends, const std::array<double, 3>& k_N_m) {
    auto body = rod->body;
    for (const auto& end : ends) body.elastic_supports.push_back({rod->ports.at(end), k_N_m});
    return body;
  }
  static std::string refusal(const fem::Body& body, int n_modes) {
    try {
      fem::Model(body).natural_frequencies(n_modes);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }
  static fem_tests::ShaftBody* rod;
  static std::vector<fem::NaturalMode>* free_modes;
};
fem_tests::ShaftBody* Vibrations::rod;
std::vector<fem::NaturalMode>* Vibrations::free_modes;

// Against a sum over more points than the degree 5 k - 1 (tetrahedra: 7) needs, on a cell whose nodes are out
// of place: one point less than exact is off by some 1e-4.
TEST(Mass, IsExactOnBentCells) {
  std::mt19937 engine(3);
  const auto bend = [&](const Eigen::Vector3d& x) {
    const auto shift = [&] { return 0.05 * (double(engine()) / double(std::mt19937::max()) - 0.5); };
    return Eigen::Vector3d(x[0] + shift(), x[1] + shift(), x[2] + shift());
  };
  std::vector<std::pair<fem::Grid, int>> cells = {{fem_tests::tetrahedra_block({1, 1, 1}, bend), 5}};
  for (const int degree : {1, 2, 3}) {
    fem::Grid grid;
    grid.degree = degree;
    for (const auto& at : fem::nodes_in_cell(grid.shape()).point)
      for (const double c : bend({at[0], at[1], at[2]})) grid.xyz_m.push_back(c);
    grid.n_nodes = grid.xyz_m.size() / 3;
    for (std::size_t i = 0; i < grid.n_nodes; ++i) grid.cell_nodes.push_back(static_cast<std::int32_t>(i));
    grid.volume_id = {7};
    cells.emplace_back(grid, 9);
  }
  for (const auto& [grid, n_points] : cells) {
    const auto at = fem::gauss_in_cell(grid.shape(), n_points);
    const auto n = static_cast<Eigen::Index>(grid.n_nodes);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t c = 0; c < grid.n_cells(); ++c)
      for (int q = 0; q < at.n_points; ++q)
        for (int i = 0; i < at.n_shapes; ++i)
          for (int j = 0; j < at.n_shapes; ++j)
            expected(grid.nodes_of(c)[i], grid.nodes_of(c)[j]) +=
                3 * at.weight[q] * fem::jacobian(grid, c, at, q).determinant() *
                at.value[q * at.n_shapes + i] * at.value[q * at.n_shapes + j];
    const Eigen::MatrixXd ours = mass_matrix(grid, 3) * Eigen::MatrixXd::Identity(3 * n, 3 * n);
    double error = 0;
    for (Eigen::Index i = 0; i < 3 * n; ++i)
      for (Eigen::Index j = 0; j < 3 * n; ++j)
        error = std::max(error, std::abs(ours(i, j) - (i % 3 == j % 3 ? expected(i / 3, j / 3) : 0)));
    EXPECT_LT(error, 1e-12 * expected.maxCoeff()) << "degree " << grid.degree;
  }
}

TEST_F(Vibrations, ShapesAreOrthonormalInTheMass) {
  auto clamped = rod->body;
  clamped.clamps = {{rod->ports.at("end_1").boundary_id, {true, true, true}}};
  const auto grid = fem::make_grid(rod->body);
  const auto mass = mass_matrix(grid, rod->body.material.density_kg_m3);
  for (const auto& modes : {*free_modes, fem::Model(clamped).natural_frequencies(5)}) {
    const Eigen::MatrixXd x = shapes(modes), gram = x.transpose() * (mass * x);
    // 1e-10: the last step's small eigenvalue problem, eps times the spread of its w^2, some 1e3.
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(x.cols(), x.cols())).cwiseAbs().maxCoeff(), 1e-10);
    for (const auto& mode : modes) EXPECT_LE(mode.residual, 1e-7);  // eps times |K| over these w^2
  }
}

// The shortest mode of all is a bending one; the rod's torsion is among the eight: n/(2 L) sqrt(G / rho).
TEST_F(Vibrations, RigidMotionsAreLeftOut) {
  const auto grid = fem::make_grid(rod->body);
  const auto mass = mass_matrix(grid, rod->body.material.density_kg_m3);
  const Eigen::MatrixXd rigid = fem::rigid_modes(grid, {0, 0, length_m / 2});
  const Eigen::MatrixXd along = rigid.transpose() * (mass * shapes(*free_modes));
  const Eigen::VectorXd size = (rigid.transpose() * (mass * rigid)).diagonal().cwiseSqrt();
  EXPECT_LT((size.cwiseInverse().asDiagonal() * along).cwiseAbs().maxCoeff(), 1e-9);  // the solver's rounding
  ASSERT_EQ(free_modes->size(), 8u);
  const double torsion_Hz = std::sqrt(206e9 / 2.6 / 7850) / (2 * length_m);
  double nearest = 1;
  for (std::size_t i = 0; i < 8; ++i) {
    const double f = (*free_modes)[i].frequency_Hz;
    EXPECT_GT(f, 1000);
    EXPECT_GE(f, i > 0 ? (*free_modes)[i - 1].frequency_Hz : 0);
    nearest = std::min(nearest, std::abs(f / torsion_Hz - 1));
  }
  EXPECT_LT(nearest, 2e-3);  // eight sectors
}

// Fewer modes are the first ones of more, also where the number parts a pair.
TEST_F(Vibrations, AsManyAsAskedFor) {
  const fem::Model model(rod->body);
  for (const int n : {1, 3}) {
    const auto some = model.natural_frequencies(n);
    ASSERT_EQ(some.size(), std::size_t(n));
    for (int i = 0; i < n; ++i) {
      EXPECT_EQ(some[i].shape.size(), model.n_dofs());
      EXPECT_NEAR(some[i].frequency_Hz / (*free_modes)[i].frequency_Hz, 1, 1e-8);  // rounding, as above
    }
  }
}

TEST_F(Vibrations, RepeatBitForBit) {
  const auto again = fem::Model(rod->body).natural_frequencies(8);
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(again[i].frequency_Hz, (*free_modes)[i].frequency_Hz);
    EXPECT_EQ(again[i].residual, (*free_modes)[i].residual);
    EXPECT_EQ(again[i].shape, (*free_modes)[i].shape);
    EXPECT_GT(shapes(again).col(i).maxCoeff(), -shapes(again).col(i).minCoeff());
  }
}

TEST_F(Vibrations, ClampedNodesStay) {
  auto body = rod->body;
  body.clamps = {{rod->ports.at("end_1").boundary_id, {true, true, true}}};
  const auto nodes = fem::body_nodes(body);
  const auto modes = fem::Model(body).natural_frequencies(2);
  for (std::size_t i = 0; i < nodes.n; ++i)
    for (const auto& mode : modes)
      for (int d = 0; d < 3 && nodes.xyz_m[3 * i + 2] < 1e-12; ++d) ASSERT_EQ(mode.shape[3 * i + d], 0);
}

// A rod on soft springs at both ends is a rigid one: bounce sqrt(2 k / m) along each axis, and pitch
// sqrt(2 k (L/2)^2 / J) across the rod. Nothing holds it against turning about its axis; the next frequency
// is elastic. 1e-3: its own flexibility, k over its stiffness of some 1e8 N/m, and the eight sectors' J.
TEST_F(Vibrations, RigidBodyOnSoftSprings) {
  const double k = 1e4;
  const auto body = on_springs({"end_1", "end_2"}, {k, 2 * k, 4 * k});
  const fem::Model model(body);
  const auto mass = model.mass_properties();
  const double m = mass.mass_kg, half = length_m / 2;
  const double across =
      mass.second_moments_kg_m2[0] + mass.second_moments_kg_m2[2] - m * half * half;  // about the centre
  const auto f = [](double stiffness, double inertia) { return std::sqrt(stiffness / inertia) / (2 * pi); };
  std::vector<double> expected = {f(2 * k, m), f(4 * k, m), f(8 * k, m), f(2 * k * half * half, across),
                                  f(4 * k * half * half, across)};
  std::sort(expected.begin(), expected.end());
  const auto modes = model.natural_frequencies(6);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(modes[i].frequency_Hz / expected[i], 1, 1e-3) << i;
  EXPECT_NEAR(modes[5].frequency_Hz / (*free_modes)[0].frequency_Hz, 1, 1e-3);
}

// On springs a thousand times softer the rod's own flexibility, k over 1e8 N/m, no longer counts. 1e-6: a
// frequency that came from u'K u would be off by K's rounding of a rigid motion, some 1e-5 of w^2.
TEST_F(Vibrations, SofterSpringsLoseNoDigits) {
  const double k = 10;
  const fem::Model model(on_springs({"end_1", "end_2"}, {k, k, k}));
  const double expected_Hz = std::sqrt(2 * k / model.mass_properties().mass_kg) / (2 * pi);
  const auto modes = model.natural_frequencies(4);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(modes[std::size_t(i)].frequency_Hz / expected_Hz, 1, 1e-6) << i;
}

// Without Poisson's ratio the rod is a bar: held by k at one end, with (w L / c) tan(w L / c) = k L / (E A).
TEST_F(Vibrations, BarWithASpringAtItsEnd) {
  for (const double k_over_bar : {1e-3, 1.0, 1e5}) {
    auto body = rod->body;
    body.material.poisson_ratio = 0;
    const double area_m2 = fem::Model(body).mass_properties().volume_m3 / length_m;
    const double bar_N_m = 206e9 * area_m2 / length_m;
    body.elastic_supports = {{rod->ports.at("end_1"), {0, 0, k_over_bar * bar_N_m}}};
    double low = 0, high = pi / 2;
    while (high - low > 1e-14)
      (((low + high) / 2) * std::tan((low + high) / 2) < k_over_bar ? low : high) = (low + high) / 2;
    const double expected_Hz = low * std::sqrt(206e9 / 7850) / length_m / (2 * pi);
    double nearest = 1;
    for (const auto& mode : fem::Model(body).natural_frequencies(6))
      nearest = std::min(nearest, std::abs(mode.frequency_Hz / expected_Hz - 1));
    // Four quadratic cells of length h along the rod: (w h / c)^4 / 1440 = 1.7e-5 for the stiffest spring.
    EXPECT_LT(nearest, 3e-5) << k_over_bar;
  }
}

// With a mass that moves with one end and lies in the middle, the rigid rod bounces as sqrt(2 k / (m + M))
// and pitches with both inertias: the end's motion carries the mass past half the rod.
TEST_F(Vibrations, RigidBodyWithAnAttachedMass) {
  const double k = 1e4, half = length_m / 2;
  const fem::Model model(on_springs({"end_1", "end_2"}, {k, 2 * k, 4 * k}));
  const auto mass = model.mass_properties();
  const fem::AttachedMass disc{rod->ports.at("end_2"), 7.5, {0, 0, -half}, {0.11, 0.05, 0.3}};
  const double m = mass.mass_kg,
               across = mass.second_moments_kg_m2[0] + mass.second_moments_kg_m2[2] - m * half * half;
  const auto f = [](double stiffness, double inertia) { return std::sqrt(stiffness / inertia) / (2 * pi); };
  std::vector<double> expected = {f(2 * k, m + 7.5), f(4 * k, m + 7.5), f(8 * k, m + 7.5),
                                  f(2 * k * half * half, across + 0.05),
                                  f(4 * k * half * half, across + 0.11)};
  std::sort(expected.begin(), expected.end());
  const auto modes = model.natural_frequencies(5, {disc});
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(modes[i].frequency_Hz / expected[i], 1, 1e-3) << i;  // as without it
}

// Clamped at one end, with a disc at the other one, a rod turns at x tan x = J / J_disc, x = w L sqrt(rho /
// G), and, as a bar without Poisson's ratio, stretches at x tan x = m / m_disc, x = w L sqrt(rho / E).
TEST_F(Vibrations, ClampedRodWithADiscAtItsEnd) {
  auto body = rod->body;
  body.material.poisson_ratio = 0;
  body.clamps = {{rod->ports.at("end_1").boundary_id, {true, true, true}}};
  const fem::Model model(body);
  const auto mass = model.mass_properties();
  const double polar = mass.second_moments_kg_m2[0] + mass.second_moments_kg_m2[1];
  const fem::AttachedMass disc{rod->ports.at("end_2"), 2 * mass.mass_kg, {}, {polar, polar, polar / 2}};
  const auto root = [](double ratio) {
    double low = 0, high = pi / 2;
    while (high - low > 1e-14)
      (((low + high) / 2) * std::tan((low + high) / 2) < ratio ? low : high) = (low + high) / 2;
    return low;
  };
  const double wave_m_s = std::sqrt(206e9 / 7850);
  const auto modes = model.natural_frequencies(6, {disc});
  // Torsion: an octagon's J is beside its torsion constant by some 0.1 %. Stretching: cells alone, as above.
  for (const auto& [expected_Hz, off] :
       {std::pair(root(2) * wave_m_s / std::sqrt(2) / length_m / (2 * pi), 3e-3),
        std::pair(root(0.5) * wave_m_s / length_m / (2 * pi), 3e-4)}) {
    double nearest = 1;
    for (const auto& mode : modes) nearest = std::min(nearest, std::abs(mode.frequency_Hz / expected_Hz - 1));
    EXPECT_LT(nearest, off) << expected_Hz;
  }
}

// The residual told is that of K and M as the test assembles them.
TEST_F(Vibrations, ResidualIsThatOfTheMatrices) {
  const auto grid = fem::make_grid(rod->body);
  const auto cells = fem::cells_of_nodes(grid);
  const auto graph = fem::make_node_graph(grid, cells);
  auto stiffness = fem::make_matrix(graph);
  fem::assemble_stiffness(grid, fem::colour_cells(grid, cells), graph, fem::lame(rod->body.material),
                          stiffness);
  const Eigen::MatrixXd x = shapes(*free_modes);
  const Eigen::MatrixXd force = fem::multiply(stiffness, x),
                        inertia = mass_matrix(grid, rod->body.material.density_kg_m3) * x;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const auto& mode = (*free_modes)[i];
    const double w = 2 * pi * mode.frequency_Hz;
    const double residual = (force.col(i) - w * w * inertia.col(i)).norm() / (w * w * inertia.col(i)).norm();
    EXPECT_GT(mode.residual, 0);
    EXPECT_NEAR(residual, mode.residual, 0.5 * mode.residual);  // both are rounding, or nearly
  }
}

// The first frequency of a wire 500 times as long as thick lies so far below the mesh's highest one that
// rounding, eps L^4 / d^4 and more, leaves it without meaning.
TEST_F(Vibrations, ModesLostInRoundingAreRefused) {
  fem::Body wire;
  wire.mesh = fem_tests::cells_of(fem_tests::tetrahedra_block({1, 1, 20}, [](const Eigen::Vector3d& c) {
    return Eigen::Vector3d(0.002 * c[0], 0.002 * c[1], c[2]);
  }));
  wire.material = rod->body.material;
  wire.clamps = {{5, {true, true, true}}};
  try {
    fem::Model(wire).natural_frequencies(2);
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("natural frequency 1"), std::string::npos) << error.what();
  }
}

TEST_F(Vibrations, Refusals) {
  for (const int n : {0, -3, 1000000}) {
    const auto text = refusal(rod->body, n);
    EXPECT_NE(text.find(std::to_string(n) + " asked for"), std::string::npos) << text;
  }
  auto body = on_springs({"end_2"}, {1e6, 1e6, 1e6});
  body.clamps = {{rod->ports.at("end_1").boundary_id, {true, true, true}}};
  EXPECT_NE(refusal(body, 1).find("leave one of them out"), std::string::npos);
  body = rod->body;
  body.clamps = {{rod->ports.at("end_1").boundary_id, {true, true, false}}};
  EXPECT_NE(refusal(body, 1).find("rigid motion"), std::string::npos);
}

}  // namespace
