// Bodies that are their own mirror image are solved by halves: the same as by the factor of the whole body.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "fem/solve/solvers/mirrored_halves.h"
#include "meshes/chamber/chamber.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/unit/meshes/examples/example_chambers.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using Field = fem::BodyForce::Field;

/// Rounding of both factors; loads as applied are up to a hundred times what is left of them, balanced.
constexpr double same_solution = 1e-9;

/// Of the largest energy norm of all channels; what has less is a uniform acceleration, which its own balance
/// takes away.
constexpr double no_response = 1e-6;

std::vector<std::size_t> channels_with_response(const fem::UnitResponses& responses) {
  const auto& norm = responses.energy_error.norm_sqrtJ;
  const double largest = *std::max_element(norm.begin(), norm.end());
  std::vector<std::size_t> channels;
  for (std::size_t k = 0; k < norm.size(); ++k)
    if (norm[k] > no_response * largest) channels.push_back(k);
  return channels;
}

struct Pair {
  std::shared_ptr<const fem::Model> model;
  fem::UnitResponses halves, whole;
};

Pair solve(const fem::Body& body, const std::vector<fem::UnitLoad>& loads) {
  Pair pair;
  pair.model = std::make_shared<const fem::Model>(body);
  fem::SolverChoice choice;
  choice.solver = fem::Solver::direct;
  choice.by_halves = false;
  pair.whole = pair.model->unit_responses(loads, {}, fem::Recovery::patch, {}, choice);
  choice.by_halves = true;
  choice.keep_factor = true;
  pair.halves = pair.model->unit_responses(loads, {}, fem::Recovery::patch, {}, choice);
  return pair;
}

void expect_same(const Pair& pair) {
  const auto &halves = pair.halves, &whole = pair.whole;
  const std::size_t n = whole.channels.size();
  const auto channels = channels_with_response(whole);
  EXPECT_GE(channels.size() + 1, n);
  EXPECT_LT(fem_tests::difference(halves.displacement_m, whole.displacement_m, channels, n, 3),
            same_solution);
  EXPECT_LT(fem_tests::difference(halves.stress_Pa, whole.stress_Pa, channels, n, 6), same_solution);
  EXPECT_LT(halves.residual, 1e-8);
  EXPECT_LT(halves.support_reaction, 1e-8);
  for (const auto k : channels)
    for (const auto l : channels) {
      EXPECT_NEAR(halves.energy_error.energy[k * n + l], whole.energy_error.energy[k * n + l], 1e-8);
      EXPECT_NEAR(halves.energy_error.error[k * n + l], whole.energy_error.error[k * n + l], 1e-8);
    }
}

std::optional<fem::MirrorPlane> plane_of(const fem::Grid& grid) {
  return fem::find_mirror_plane(grid, fem::cells_of_nodes(grid));
}

/// One cell in `every` drawn and cut, and their images.
fem::Body with_cells_cut(fem::Body body, unsigned every) {
  const auto plane = plane_of(fem::make_grid(body));
  if (!plane) throw std::logic_error("the body has no mirror plane");
  std::mt19937 random(7);
  std::vector<char> is_cut(plane->cell.size(), 0);
  for (std::size_t c = 0; c < is_cut.size(); ++c)
    if (random() % every == 0) is_cut[c] = is_cut[std::size_t(plane->cell[c])] = 1;
  std::vector<std::int32_t> cells;
  for (std::size_t c = 0; c < is_cut.size(); ++c)
    if (is_cut[c] != 0) cells.push_back(std::int32_t(c));
  body.refinements = {{cells}};
  return body;
}

/// Even ones, odd ones, and others.
std::vector<fem::UnitLoad> loads_of(const fem_tests::ShaftBody& shaft) {
  return {fem_tests::resultant(shaft, "bearing_1", Component::fy),
          fem_tests::resultant(shaft, "seat", Component::fx),
          fem_tests::resultant(shaft, "seat", Component::fz),
          fem_tests::resultant(shaft, "bearing_2", Component::torque),
          fem_tests::resultant(shaft, "seat", Component::mx),
          {"seat.p2s", fem::SeatPressure{shaft.ports.at("seat"), 2, 1, fem::SeatPressure::Phase::sine}},
          {"volume.ax", fem::BodyForce{Field::translation_x}},
          {"volume.omega2", fem::BodyForce{Field::spin}}};
}

struct Chamber {
  fem::Body body;
  std::vector<fem::UnitLoad> loads;
  std::vector<int> housing;  ///< volumes
};

Chamber chamber_of(const meshes::Chamber& shape) {
  meshes::ChamberMeshControl control;
  control.cells_through_wall = 1;
  control.toe_walls = 2;
  control.lean = true;
  const auto mesh = meshes::build_chamber(shape, control);
  Chamber chamber{fem_tests::steel_body(mesh), {}, {}};
  chamber.loads = {{"volume.omega2", fem::BodyForce{Field::spin}},
                   {"volume.alpha", fem::BodyForce{Field::rotation}}};
  for (const auto& port : mesh.ports) {
    if (port.name == "covers") continue;
    const bool is_face = port.kind == meshes::Port::Kind::face;
    const fem::LoadSurface surface{is_face ? fem::LoadSurface::Kind::face : fem::LoadSurface::Kind::seat,
                                   port.boundary_id,
                                   {port.axis_x_m, port.axis_y_m, (port.begin_m + port.end_m) / 2},
                                   is_face ? 0 : port.radius_m,
                                   is_face ? 0 : port.end_m - port.begin_m};
    for (const auto& [name, component] : {std::pair{".fx", Component::fx}, std::pair{".fy", Component::fy}})
      chamber.loads.push_back({port.name + name, fem::SurfaceResultant{surface, component}});
  }
  chamber.housing = mesh.regions.at(1).volume_ids;
  return chamber;
}

TEST(Halves, OfShaftsUnderAnyLoadAreTheWhole) {
  const auto shaft = fem_tests::mirrored_shaft();
  const auto pair = solve(shaft.body, loads_of(shaft));
  expect_same(pair);
  EXPECT_TRUE(pair.halves.images.node.empty()) << "seat.fz is not mirrored";
  // Turns red: both halves solved as one body.
  EXPECT_LT(pair.halves.solver.factor.flops, 0.75 * pair.whole.solver.factor.flops);
}

TEST(Halves, OfRefinedShaftsAreTheWhole) {
  const auto shaft = fem_tests::mirrored_shaft();
  const auto pair = solve(with_cells_cut(shaft.body, 12), loads_of(shaft));
  expect_same(pair);
}

TEST(Halves, OfShaftsOnSpringsAreTheWhole) {
  auto shaft = fem_tests::mirrored_shaft();
  shaft.body.elastic_supports = {{shaft.ports.at("bearing_1"), {1e8, 2e8, 0}},
                                 {shaft.ports.at("seat"), {3e7, 3e7, 0}},
                                 {shaft.ports.at("bearing_2"), {1e8, 2e8, 0}}};
  expect_same(solve(shaft.body, loads_of(shaft)));
}

// All of the laboratory chamber's loads are mirrored about its middle: one half is solved, and stress is
// mirrored to the last bit.
TEST(Halves, OfChambersAreSolvedOnce) {
  const auto chamber = chamber_of(laboratory_chamber());
  const auto pair = solve(with_cells_cut(chamber.body, 40), chamber.loads);
  expect_same(pair);
  const auto& images = pair.halves.images;
  ASSERT_EQ(images.node.size(), pair.halves.nodes.n);
  ASSERT_EQ(images.cell.size(), pair.halves.nodes.n_cells());
  const std::size_t n = pair.halves.channels.size();
  for (std::size_t i = 0; i < images.node.size(); ++i) {
    const auto image = std::size_t(images.node[i]);
    ASSERT_NEAR(pair.halves.nodes.xyz_m[3 * i + 2], -pair.halves.nodes.xyz_m[3 * image + 2], 1e-10);
    if (image == i) continue;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t c = 0; c < 6; ++c) {
        const double sign = c > 3 ? -1 : 1;  // yz, xz
        ASSERT_EQ(pair.halves.stress_Pa[(i * n + k) * 6 + c],
                  sign * pair.halves.stress_Pa[(image * n + k) * 6 + c]);
      }
  }
  EXPECT_LT(pair.halves.solver.factor.flops, 0.4 * pair.whole.solver.factor.flops);
}

// A goal in the middle is as the factor of the whole body has it; one beside it shares itself with its image.
TEST(Halves, KnowTheErrorsOfGoals) {
  const auto chamber = chamber_of(laboratory_chamber());
  const auto pair = solve(chamber.body, chamber.loads);
  const auto& nodes = pair.halves.nodes;
  const auto& images = pair.halves.images;
  std::size_t middle = 0, side = 0;
  for (std::size_t i = 0; i < nodes.n; ++i) {
    if (std::size_t(images.node[i]) == i && nodes.xyz_m[3 * i] > nodes.xyz_m[3 * middle]) middle = i;
    if (nodes.xyz_m[3 * i] + nodes.xyz_m[3 * i + 2] > nodes.xyz_m[3 * side] + nodes.xyz_m[3 * side + 2])
      side = i;
  }
  std::vector<double> factors(chamber.loads.size(), 0);
  factors[2] = 1;
  const std::array<double, 6> tensor{0.4, 1, -0.3, 0.2, 0, 0};
  const fem::StressGoal in_middle{factors, {{middle, tensor}}}, at_side{factors, {{side, tensor}}},
      at_image{factors, {{std::size_t(images.node[side]), tensor}}};
  const auto halves = pair.model->goal_errors_Pa(pair.halves, {in_middle, at_side, at_image});
  // Of a model without a factor, and responses that say nothing of images.
  const fem::Model other(chamber.body);
  const auto whole = other.goal_errors_Pa(pair.whole, {in_middle, at_side});
  double sum_halves = 0, sum_whole = 0;
  const double largest = *std::max_element(whole[0].begin(), whole[0].end());
  for (std::size_t c = 0; c < images.cell.size(); ++c) {
    EXPECT_NEAR(halves[0][c], whole[0][c], 1e-6 * largest);
    EXPECT_EQ(halves[1][c], halves[1][std::size_t(images.cell[c])]);
    EXPECT_NEAR(halves[1][c], halves[2][c], 1e-9 * largest);
    sum_halves += halves[1][c];
    sum_whole += whole[1][c];
  }
  // What a place feels of the far side, its image feels of this one: the sums are near each other.
  EXPECT_NEAR(sum_halves, sum_whole, 0.1 * sum_whole);
}

// Responses that are not mirrored need the part of dual solutions that a factor of one half leaves out.
TEST(Halves, AFactorOfOneHalfIsNotTakenForOtherResponses) {
  const auto shaft = fem_tests::mirrored_shaft();
  const fem::Model model(shaft.body);
  fem::SolverChoice choice;
  choice.solver = fem::Solver::direct;
  choice.keep_factor = true;
  const auto even = model.unit_responses({{"volume.omega2", fem::BodyForce{Field::spin}}}, {},
                                         fem::Recovery::patch, {}, choice);
  ASSERT_FALSE(even.images.node.empty());
  choice.keep_factor = false;
  const auto odd = model.unit_responses({fem_tests::resultant(shaft, "bearing_1", Component::fy)}, {},
                                        fem::Recovery::patch, {}, choice);
  ASSERT_TRUE(odd.images.node.empty());
  const fem::StressGoal goal{{1}, {{1000, {1, 0, 0, 0, 0, 0}}}};
  const auto errors = model.goal_errors_Pa(odd, {goal}),
             expected = fem::Model(shaft.body).goal_errors_Pa(odd, {goal});
  const double largest = *std::max_element(expected[0].begin(), expected[0].end());
  for (std::size_t c = 0; c < expected[0].size(); ++c)
    ASSERT_NEAR(errors[0][c], expected[0][c], 1e-8 * largest);
}

TEST(Halves, OfABodyThatIsNotMirroredDoNotExist) {
  const auto chamber = chamber_of(lopsided_chamber());
  EXPECT_FALSE(plane_of(fem::make_grid(chamber.body)));

  // The plane cuts through cells: one factor of the whole body, whatever is asked for.
  auto middle_is_bare = fem_tests::small_eccentric_shaft();
  middle_is_bare.segments[1].is_port = false;  // else its mesh has a boundary in the middle
  meshes::ShaftMeshControl control;
  control.cells_per_fillet_quarter = 2;
  control.n_sectors = 8;
  const auto cut = fem_tests::build(middle_is_bare, control);
  EXPECT_FALSE(plane_of(fem::make_grid(cut.body)));
  const auto pair = solve(cut.body, {fem_tests::resultant(cut, "bearing_1", Component::fy),
                                     {"volume.omega2", fem::BodyForce{Field::spin}}});
  EXPECT_EQ(pair.halves.stress_Pa, pair.whole.stress_Pa);
  EXPECT_TRUE(pair.halves.images.node.empty());

  // A mesh whose nodes are mirrored, all but one.
  const auto shaft = fem_tests::mirrored_shaft();
  auto grid = fem::make_grid(shaft.body);
  ASSERT_TRUE(plane_of(grid));
  grid.xyz_m[3 * 500 + 1] += 1e-7;
  EXPECT_FALSE(plane_of(grid));
}

}  // namespace
