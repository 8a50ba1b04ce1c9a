// Several ranks give what one rank gives. The same program has both: a communicator of one rank, and that of
// all ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fem/base/common/deadline.h"
#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/ranks/deal_out_cells.h"
#include "fem/mesh/ranks/ranks.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "fem/solve/solvers/petsc_solver.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

using Component = fem::SurfaceResultant::Component;

/// Of the largest entry of each channel. Both answers are right to their residual times what the stiffness
/// amplifies: rounding, 1e-16 times a condition of 1e4 to 1e6 for the factor; 1e-12 asked of the iteration.
constexpr double same_answer = 1e-10;

double difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t n_channels,
                  std::size_t n_components) {
  EXPECT_EQ(a.size(), b.size());
  EXPECT_FALSE(a.empty());
  double worst = 0;
  for (std::size_t k = 0; k < n_channels; ++k) {
    double largest = 0, scale = 0;
    for (std::size_t i = k * n_components; i < a.size(); i += n_channels * n_components)
      for (std::size_t c = 0; c < n_components; ++c) {
        largest = std::max(largest, std::abs(a[i + c] - b[i + c]));
        scale = std::max(scale, std::abs(b[i + c]));
      }
    EXPECT_GT(scale, 0) << "channel " << k;
    worst = std::max(worst, largest / scale);
  }
  return worst;
}

/// Rows of all nodes, from the ranks that have them.
std::vector<double> whole(const fem::UnitResponses& responses, const std::vector<double>& rows,
                          std::size_t n_components) {
  if (!responses.shared) return rows;
  const std::size_t width = responses.channels.size() * n_components;
  EXPECT_EQ(rows.size(), responses.n_rows() * width);
  EXPECT_LT(responses.n_rows(), responses.nodes.n) << "each rank has some";
  std::vector<double> all(responses.nodes.n * width, 0.0);
  for (std::size_t row = 0; row < responses.n_rows(); ++row)
    std::copy_n(&rows[row * width], width, &all[responses.node_of_row(row) * width]);
  responses.complete(all);
  return all;
}
std::vector<double> displacement(const fem::UnitResponses& responses) {
  return whole(responses, responses.displacement_m, 3);
}
std::vector<double> stress(const fem::UnitResponses& responses) {
  return whole(responses, responses.stress_Pa, 6);
}

struct Ranks : testing::Test {
  static int number() { return fem::n_ranks(MPI_COMM_WORLD); }
  void SetUp() override { ASSERT_GT(number(), 1) << "to be started by mpirun -n 2"; }

  static fem::UnitResponses solve(const fem::Body& body, const std::vector<fem::UnitLoad>& loads,
                                  fem::Solver solver, MPI_Comm communicator,
                                  const std::vector<fem::SectionPlane>& planes = {}) {
    fem::SolverChoice choice;
    choice.solver = solver;
    choice.relative_tolerance = 1e-12;
    choice.by_halves = false;  // which rank 0 solves alone
    return fem::Model(body, communicator).unit_responses(loads, planes, fem::Recovery::patch, {}, choice);
  }

  /// @return of several ranks
  static fem::UnitResponses expect_same(const fem::Body& body, const std::vector<fem::UnitLoad>& loads,
                                        fem::Solver solver,
                                        const std::vector<fem::SectionPlane>& planes = {}) {
    const auto one = solve(body, loads, solver, MPI_COMM_SELF, planes);
    auto several = solve(body, loads, solver, MPI_COMM_WORLD, planes);
    EXPECT_EQ(one.solver.used, solver) << one.solver.reason;
    EXPECT_EQ(several.solver.used, solver) << several.solver.reason;
    EXPECT_TRUE(one.solver.ranks.empty());
    EXPECT_LE(std::abs(several.solver.n_iterations - one.solver.n_iterations),
              1 + one.solver.n_iterations / 5)
        << several.solver.n_iterations << " steps, " << one.solver.n_iterations
        << " on one rank: incomplete factors of the ranks know nothing of each other";
    EXPECT_LT(difference(displacement(several), one.displacement_m, loads.size(), 3), same_answer);
    EXPECT_LT(difference(stress(several), one.stress_Pa, loads.size(), 6), same_answer);
    EXPECT_LT(several.residual, 1e-8);  // as one rank must have it
    const auto same_numbers = [](const std::vector<double>& a, const std::vector<double>& b) {
      ASSERT_EQ(a.size(), b.size());
      const Eigen::Map<const Eigen::ArrayXd> x(a.data(), Eigen::Index(a.size())),
          y(b.data(), Eigen::Index(b.size()));
      EXPECT_LT((x - y).abs().maxCoeff(), same_answer * y.abs().maxCoeff());
    };
    same_numbers(several.energy_error.norm_sqrtJ, one.energy_error.norm_sqrtJ);
    same_numbers(several.energy_error.error, one.energy_error.error);
    same_numbers(several.energy_error.of_cells, one.energy_error.of_cells);
    EXPECT_EQ(several.ring_shear_Pa.size(), one.ring_shear_Pa.size());
    if (!one.ring_shear_Pa.empty()) {
      const auto numbers = [](const auto& pairs) {
        return std::vector<double>(pairs.front().data(), pairs.front().data() + 2 * pairs.size());
      };
      same_numbers(numbers(several.ring_shear_Pa), numbers(one.ring_shear_Pa));
    }
    const auto resultants = [](const fem::UnitResponses& responses) {
      std::vector<double> all;
      for (const auto& section : responses.sections)
        all.insert(all.end(), section.resultant.begin(), section.resultant.end());
      return all;
    };
    const auto turns = [](const fem::UnitResponses& responses) {
      std::vector<double> all;
      for (const auto& section : responses.sections)
        all.insert(all.end(), section.rotation_rad.begin(), section.rotation_rad.end());
      return all;
    };
    EXPECT_EQ(one.sections.size(), planes.size() * loads.size());
    if (!planes.empty()) {
      same_numbers(resultants(several), resultants(one));
      same_numbers(turns(several), turns(one));
    }
    expect_shares(several);
    return several;
  }

  /// Every rank has its share: cells to one, but that under the iteration rank 0 has fewer, and the factor of
  /// the lower level; and unknowns to what the borders between ranks have, which go to the first of their
  /// ranks: a third of a quarter of the disc.
  static void expect_shares(const fem::UnitResponses& responses) {
    const auto& ranks = responses.solver.ranks;
    ASSERT_EQ(int(ranks.size()), number());
    const bool is_iterative = responses.solver.used == fem::Solver::iterative;
    std::size_t unknowns = 0, cells = 0, most = 0, fewest = std::size_t(-1);
    double bytes = 0, most_bytes = 0;
    for (const auto& rank : ranks) {
      cells += rank.n_cells;
      most = std::max(most, rank.n_cells);
      if (!is_iterative || &rank != &ranks[0]) fewest = std::min(fewest, rank.n_cells);
      unknowns += rank.n_unknowns;
      bytes += rank.bytes;
      most_bytes = std::max(most_bytes, rank.bytes);
      EXPECT_GT(rank.bytes, 0);
      EXPECT_LT(double(rank.n_unknowns), 1.5 * double(responses.n_dofs) / number());
    }
    EXPECT_EQ(cells, responses.nodes.n_cells()) << "every cell is counted once";
    EXPECT_EQ(unknowns, responses.n_dofs) << "every unknown is counted once";
    EXPECT_LE(most - fewest, is_iterative ? 2u : 1u) << "a half at each halving";
    if (is_iterative) {
      EXPECT_LT(ranks[0].n_cells, ranks[1].n_cells);
      EXPECT_LT(most_bytes, 1.5 * bytes / number()) << "as the unknowns";
    }
  }
};

std::vector<fem::UnitLoad> some_loads(const fem_tests::ShaftBody& shaft) {
  std::vector<fem::UnitLoad> loads;
  for (const auto c : {Component::fx, Component::fz, Component::torque})
    for (const auto* port : {"end_1", "end_2"}) loads.push_back(fem_tests::resultant(shaft, port, c));
  loads.push_back({"volume.omega2", fem::BodyForce{fem::BodyForce::Field::spin}});
  return loads;
}

/// For the iteration, which solves one after another.
std::vector<fem::UnitLoad> few_loads(const fem_tests::ShaftBody& shaft) {
  return {fem_tests::resultant(shaft, "end_1", Component::fx),
          fem_tests::resultant(shaft, "end_2", Component::torque),
          {"volume.omega2", fem::BodyForce{fem::BodyForce::Field::spin}}};
}

// Of the eccentric shaft below, with hanging nodes.
TEST_F(Ranks, HexahedraDirectly) {
  const auto rod = fem_tests::rod(8);
  const auto responses = expect_same(rod.body, some_loads(rod), fem::Solver::direct, rod.planes);
  EXPECT_FALSE(responses.planes.empty());
  EXPECT_LT(responses.support_reaction, 1e-9) << "balanced loads leave round-off to the support";
  EXPECT_GT(responses.factor_gigabytes, 0);
}

TEST_F(Ranks, HexahedraIteratively) {
  const auto shaft = fem_tests::eccentric_shaft(2);
  const auto responses = expect_same(shaft.body, few_loads(shaft), fem::Solver::iterative);
  EXPECT_GT(responses.solver.n_iterations, 4);
}

/// With hanging nodes wherever ranks meet, some of them on cells of other ranks, in chains over two levels.
fem_tests::ShaftBody refined_shaft() {
  auto shaft = fem_tests::eccentric_shaft(2);
  shaft.body = fem_tests::refined_at_random(shaft.body, 2, 0.02, 1);
  return shaft;
}

// Turns red: cells that others' nodes hang on without those that they hang on themselves.
TEST_F(Ranks, RefinedHexahedraDirectly) {
  const auto shaft = refined_shaft();
  expect_same(shaft.body, some_loads(shaft), fem::Solver::direct);
}

// Corners of cubic cells hang too, on edges that have no node in their middle.
TEST_F(Ranks, RefinedCubicHexahedraDirectly) {
  auto rod = fem_tests::rod(8);
  rod.body.degree = 3;
  rod.body = fem_tests::refined_at_random(rod.body, 1, 0.05, 3);
  expect_same(rod.body, some_loads(rod), fem::Solver::direct);
}

// Turns red: rows without the cells of other ranks; corners that hang left out of the trilinear level.
TEST_F(Ranks, RefinedHexahedraIteratively) {
  const auto shaft = refined_shaft();
  expect_same(shaft.body, few_loads(shaft), fem::Solver::iterative);
}

// Every rank has all cells once, and of the nodes that its cells hang on every one.
TEST_F(Ranks, SharesKnowWhatTheirNodesHangOn) {
  const auto grid = fem::make_grid(refined_shaft().body);
  const auto cells = fem::cells_of_nodes(grid);
  for (const int n : {2, 3, 7}) {
    const auto rank = fem::deal_out_cells(grid, n);
    std::size_t n_own = 0, n_there = 0;
    for (int r = 0; r < n; ++r) {
      const auto share =
          fem::share_of_rank(grid, cells, rank, r, fem::cell_after_cell({grid.n_cells(), {1, 1}}));
      n_own += share.n_own_cells();
      n_there += share.part.cell.size();
      for (const auto node : share.part.grid.hanging.master) EXPECT_GE(node, 0);
    }
    EXPECT_EQ(n_own, grid.n_cells());
    EXPECT_GT(n_there, n_own);
    EXPECT_LT(double(n_there), 1.5 * double(n_own)) << "few cells are there for others' nodes";
  }
}

// By the factor of one half, on rank 0.
TEST_F(Ranks, HalvesAreThoseOfOneRank) {
  const auto shaft = fem_tests::mirrored_shaft();
  fem::SolverChoice choice;
  choice.solver = fem::Solver::direct;
  const std::vector<fem::UnitLoad> loads{fem_tests::resultant(shaft, "bearing_1", Component::fy),
                                         fem_tests::resultant(shaft, "bearing_2", Component::torque)};
  const auto solve = [&](MPI_Comm communicator) {
    return fem::Model(shaft.body, communicator).unit_responses(loads, {}, fem::Recovery::patch, {}, choice);
  };
  const auto one = solve(MPI_COMM_SELF), several = solve(MPI_COMM_WORLD);
  ASSERT_NE(one.solver.reason.find("mirror image"), std::string::npos) << one.solver.reason;
  EXPECT_LT(difference(displacement(several), one.displacement_m, loads.size(), 3), same_answer);
  EXPECT_EQ(several.images.node, one.images.node);
  EXPECT_TRUE(several.solver.ranks.empty());
  EXPECT_LT(difference(stress(several), one.stress_Pa, loads.size(), 6), same_answer);
}

fem::StressGoal goal_at(std::size_t node, std::size_t n_channels) {
  fem::StressGoal goal;
  goal.parts.push_back({node, {1, 0, 0, 0, 0, 0}});
  goal.factors.assign(n_channels, 1.0);
  return goal;
}

// By the kept factor of rank 0, and solved for by all of them.
TEST_F(Ranks, ErrorsOfGoalsAreThoseOfOneRank) {
  const auto shaft = fem_tests::mirrored_shaft();
  const std::vector<fem::UnitLoad> loads{fem_tests::resultant(shaft, "bearing_1", Component::fy),
                                         fem_tests::resultant(shaft, "bearing_2", Component::fy)};
  for (const bool keep : {true, false}) {
    fem::SolverChoice choice;
    choice.solver = keep ? fem::Solver::direct : fem::Solver::iterative;
    choice.relative_tolerance = 1e-12;
    choice.keep_factor = keep;
    std::vector<std::vector<double>> errors_Pa;
    for (const auto communicator : {MPI_COMM_SELF, MPI_COMM_WORLD}) {
      const fem::Model model(shaft.body, communicator);
      const auto responses = model.unit_responses(loads, {}, fem::Recovery::patch, {}, choice);
      errors_Pa.push_back(model.goal_errors_Pa(responses, {goal_at(100, loads.size())}).front());
    }
    double largest = 0, difference = 0;
    for (std::size_t c = 0; c < errors_Pa[0].size(); ++c) {
      largest = std::max(largest, errors_Pa[0][c]);
      difference = std::max(difference, std::abs(errors_Pa[1][c] - errors_Pa[0][c]));
    }
    EXPECT_GT(largest, 0);
    // The dual solution of the iteration is solved to 1e-8, not to 1e-12.
    EXPECT_LT(difference, (keep ? 1e-9 : 1e-6) * largest);
  }
}

TEST_F(Ranks, NaturalFrequenciesAreThoseOfOneRank) {
  const auto rod = fem_tests::rod();
  const auto one = fem::Model(rod.body, MPI_COMM_SELF).natural_frequencies(3),
             several = fem::Model(rod.body, MPI_COMM_WORLD).natural_frequencies(3);
  ASSERT_EQ(several.size(), one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(several[i].frequency_Hz, one[i].frequency_Hz);
    EXPECT_EQ(several[i].error, one[i].error);
    EXPECT_EQ(several[i].shape, one[i].shape);
  }
  EXPECT_THROW(fem::Model(rod.body, MPI_COMM_WORLD).natural_frequencies(0), std::exception);
}

// On any rank, the same rows.
TEST_F(Ranks, RowsAreKnownAnywhere) {
  const auto rod = fem_tests::rod();
  const auto loads = some_loads(rod);
  const auto responses = solve(rod.body, loads, fem::Solver::direct, MPI_COMM_WORLD);
  const auto all = stress(responses);
  const auto all_displacements = displacement(responses);
  const std::size_t width = loads.size() * 6;
  responses.bring({0, 1, 5, 1});
  for (const std::size_t node : {std::size_t(0), std::size_t(5), responses.nodes.n - 1, std::size_t(7)}) {
    EXPECT_TRUE(
        std::equal(&all[node * width], &all[node * width] + width, responses.stress_anywhere_Pa(node)));
    EXPECT_TRUE(std::equal(&all_displacements[node * width / 2],
                           &all_displacements[node * width / 2] + width / 2,
                           responses.displacement_anywhere_m(node)));
  }
}

/// Ranks meet in its ends, too.
fem_tests::ShaftBody flat_disc() {
  meshes::Shaft shaft;
  shaft.segments = {{"disc", 0, 0.02, 0.1, 0, true}};
  meshes::ShaftMeshControl control;
  control.n_sectors = 8;
  return fem_tests::build(shaft, control);
}

// Four ranks have a quarter of it each, and nodes in the middle that all of them share.
TEST_F(Ranks, DiscIteratively) {
  const auto disc = flat_disc();
  const auto grid = fem::make_grid(disc.body);
  const auto rank = fem::deal_out_cells(grid, number());
  std::vector<std::set<int>> at_node(grid.n_nodes);
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int i = 0; i < grid.nodes_per_cell(); ++i) at_node[grid.nodes_of(c)[i]].insert(rank[c]);
  std::size_t most = 0;
  for (const auto& ranks : at_node) most = std::max(most, ranks.size());
  EXPECT_EQ(int(most), number());
  const auto responses = expect_same(disc.body, few_loads(disc), fem::Solver::iterative, disc.planes);
  EXPECT_FALSE(responses.ring_shear_Pa.empty());
}

TEST_F(Ranks, IterationRepeatsBitByBit) {
  const auto disc = flat_disc();
  const auto loads = few_loads(disc);
  const auto first = solve(disc.body, loads, fem::Solver::iterative, MPI_COMM_WORLD),
             second = solve(disc.body, loads, fem::Solver::iterative, MPI_COMM_WORLD);
  EXPECT_EQ(first.displacement_m, second.displacement_m);
  EXPECT_EQ(first.stress_Pa, second.stress_Pa);
}

TEST_F(Ranks, ClampedRod) {
  auto rod = fem_tests::rod();
  rod.body.clamps = {{rod.ports.at("end_1").boundary_id}};
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative}) {
    const auto responses = expect_same(rod.body,
                                       {fem_tests::resultant(rod, "end_2", Component::fx),
                                        fem_tests::resultant(rod, "end_2", Component::torque),
                                        {"volume.az", fem::BodyForce{fem::BodyForce::Field::translation_z}}},
                                       solver);
    EXPECT_EQ(responses.support_reaction, 0);
  }
}

// Turns red: nodes of the springs' surfaces that two ranks count.
TEST_F(Ranks, Springs) {
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative}) {
    auto disc = flat_disc();
    for (const auto* end : {"end_1", "end_2"})
      disc.body.elastic_supports.push_back({disc.ports.at(end), {1e8, 1e7, 1e9}});
    expect_same(disc.body, few_loads(disc), solver);
  }
}

TEST_F(Ranks, Tetrahedra) {
  const auto grid = fem_tests::tetrahedra_block({2, 2, 8}, [](const fem_tests::Point& x) {
    return fem_tests::Point(x[0] + 0.05 * x[2] * x[2], x[1], 4 * x[2]);
  });
  fem::Body body;
  body.mesh = fem_tests::cells_of(grid);
  body.material = fem_tests::steel;
  std::vector<fem::UnitLoad> loads;
  for (const auto c : {Component::fx, Component::fz, Component::mx})
    for (const int end : {5, 6}) {
      fem::LoadSurface face;
      face.kind = fem::LoadSurface::Kind::face;
      face.boundary_id = end;
      loads.push_back({std::to_string(end) + "." + std::to_string(int(c)), fem::SurfaceResultant{face, c}});
    }
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative}) expect_same(body, loads, solver);
}

TEST_F(Ranks, IterationThatDoesNotEndTurnsToTheFactor) {
  const auto rod = fem_tests::rod();
  const auto loads = some_loads(rod);
  const auto found =
      fem::Model(rod.body, MPI_COMM_WORLD)
          .unit_responses(loads, {}, fem::Recovery::average, {}, {fem::Solver::iterative, 1e-12, 3});
  EXPECT_EQ(found.solver.used, fem::Solver::direct);
  EXPECT_NE(found.solver.reason.find("did not converge after 3 steps"), std::string::npos)
      << found.solver.reason;
  const auto one = solve(rod.body, loads, fem::Solver::direct, MPI_COMM_SELF);
  EXPECT_LT(difference(displacement(found), displacement(one), loads.size(), 3), same_answer);
}

// The time is up on one of them. All hear of it, and are in step for the next body.
TEST_F(Ranks, IterationEndsOnAllWhenTheTimeIsUp) {
  const auto rod = fem_tests::rod();
  const auto grid = fem::make_grid(rod.body);
  const auto cells = fem::cells_of_nodes(grid);
  const int rank = fem::this_rank(MPI_COMM_WORLD), n_ranks = fem::n_ranks(MPI_COMM_WORLD);
  const auto elastic = fem::lame(rod.body.material);
  const fem::PetscSolver levels({MPI_COMM_WORLD, grid, cells, elastic},
                                fem::RankPart(grid, cells, elastic, rank, n_ranks).rank_of_node, {},
                                {fem::Solver::iterative});
  Eigen::MatrixXd stretch = Eigen::MatrixXd::Zero(3 * Eigen::Index(grid.n_nodes), 1);
  stretch(2, 0) = 1;
  stretch(stretch.rows() - 1, 0) = -1;
  {
    const fem::Deadline now(rank == n_ranks - 1 ? 0 : 1e6);
    EXPECT_THROW(levels.solve(stretch), fem::OutOfTime);
  }
  expect_same(rod.body, some_loads(rod), fem::Solver::direct);
}

}  // namespace
