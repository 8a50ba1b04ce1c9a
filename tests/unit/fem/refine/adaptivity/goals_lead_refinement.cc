// Stress goals: their dual loads, and what refinement by their errors comes to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "fem/refine/adaptivity/goal_errors.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;

double von_mises_of_tensor(const std::array<double, 6>& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt((a * a + b * b + c * c) / 2 + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/// The eccentric shaft bent between its bearings, solved on some refinement.
struct Bent {
  fem_tests::ShaftBody shaft;
  std::shared_ptr<const fem::Model> model;
  fem::UnitResponses responses;
  std::size_t peak = 0;  ///< node on a fillet with the largest von Mises stress
  double peak_Pa = 0;

  explicit Bent(const fem_tests::ShaftBody& body, const std::vector<fem::RefinementCycle>& refinements,
                fem::Solver solver = fem::Solver::automatic)
      : shaft(body) {
    shaft.body.refinements = refinements;
    model = std::make_shared<const fem::Model>(shaft.body);
    fem::SolverChoice choice;
    choice.keep_factor = true;
    choice.solver = solver;
    responses = model->unit_responses({fem_tests::resultant(shaft, "bearing_1", Component::fy),
                                       fem_tests::resultant(shaft, "seat", Component::fy),
                                       fem_tests::resultant(shaft, "bearing_2", Component::fy)},
                                      {}, fem::Recovery::patch, {}, choice);
    const auto& nodes = responses.nodes;
    for (std::size_t f = 0; f < nodes.n_faces(); ++f)
      for (const auto& [name, id] : shaft.features)
        if (name.rfind("fillet", 0) == 0 && nodes.face_boundary_id[f] == id)
          for (const auto node : nodes.face(f))
            if (const double s = von_mises_of_tensor(stress(std::size_t(node))); s > peak_Pa) {
              peak_Pa = s;
              peak = std::size_t(node);
            }
  }

  std::array<double, 6> stress(std::size_t node) const {
    return fem_tests::stress(responses, {{"bearing_1.fy", 1.0}, {"seat.fy", -2.0}, {"bearing_2.fy", 1.0}},
                             node);
  }

  /// The von Mises stress at the peak.
  fem::StressGoal goal() const {
    const auto s = stress(peak);
    const double mean = (s[0] + s[1] + s[2]) / 3;
    fem::StressGoal goal{{1, -2, 1}, {{peak, {}}}};
    for (std::size_t c = 0; c < 6; ++c) goal.parts[0].tensor[c] = 1.5 * (s[c] - (c < 3 ? mean : 0)) / peak_Pa;
    return goal;
  }
};

TEST(Goals, TheirDualLoadsDoTheWorkOfAUniformStress) {
  const auto body = fem_tests::eccentric_shaft(2).body;
  const auto grid = fem::make_grid(body);
  const auto integrals = fem::integrate_nodes(grid, fem::colour_cells(grid, fem::cells_of_nodes(grid)));
  const std::vector<double> volume_m3(integrals.col(0).begin(), integrals.col(0).end());
  const fem::StressGoal goal{{},
                             {{100, {0.3, -0.2, 0.5, 0.1, -0.7, 0.4}}, {2000, {1, 0, 0.2, -0.3, 0.6, 0}}}};
  const Eigen::VectorXd load = fem::dual_load(grid, goal, volume_m3, fem::lame(body.material));
  Eigen::Matrix3d gradient;
  gradient << 1, 0.3, -0.2, 0.7, -0.4, 0.1, -0.5, 0.6, 0.8;
  gradient *= 1e-3;
  Eigen::VectorXd u(load.size());
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    u.segment<3>(3 * Eigen::Index(i)) = gradient * Eigen::Vector3d(grid.position(std::int32_t(i)));
  const auto elastic = fem::lame(body.material);
  const Eigen::Matrix3d strain = (gradient + gradient.transpose()) / 2;
  Eigen::Matrix3d stress = 2 * elastic.mu_Pa * strain;
  stress.diagonal().array() += elastic.lambda_Pa * strain.trace();
  double value = 0;
  for (const auto& part : goal.parts) {
    const auto& t = part.tensor;
    Eigen::Matrix3d tensor;
    tensor << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
    value += tensor.cwiseProduct(stress).sum();
  }
  EXPECT_NEAR(load.dot(u), value, 1e-10 * std::abs(value));
  const Eigen::MatrixXd sums = fem::resultants(grid, load, Eigen::Vector3d::Zero());
  EXPECT_LT(sums.norm(), 1e-10 * load.norm());
}

// 10 cells on the fillets' quarters all around and along stand for the truth; cutting the cells that
// contribute most comes as close with a fraction of its unknowns.
TEST(Goals, LeadRefinementToThePeak) {
  const Bent fine(fem_tests::eccentric_shaft(10), {});
  const auto coarse = fem_tests::eccentric_shaft(2);
  std::vector<fem::RefinementCycle> refinements;
  std::vector<double> off, indicated;
  std::size_t n_dofs = 0;
  for (int cycle = 0; cycle < 4; ++cycle) {
    const Bent bent(coarse, refinements);
    off.push_back(std::abs(bent.peak_Pa / fine.peak_Pa - 1));
    n_dofs = bent.responses.n_dofs;
    const auto errors_Pa = bent.model->goal_errors_Pa(bent.responses, {bent.goal()}).at(0);
    const double sum_Pa = std::accumulate(errors_Pa.begin(), errors_Pa.end(), 0.0);
    indicated.push_back(sum_Pa / bent.peak_Pa);
    auto& cut = refinements.emplace_back().cells;
    const double largest_Pa = *std::max_element(errors_Pa.begin(), errors_Pa.end());
    for (std::size_t c = 0; c < errors_Pa.size(); ++c)
      if (errors_Pa[c] > 0.1 * largest_Pa) cut.push_back(std::int32_t(c));
  }
  EXPECT_GT(off.front(), 0.05);
  EXPECT_LT(off.back(), 0.01);
  EXPECT_LT(indicated.back(), indicated.front() / 3);
  EXPECT_LT(n_dofs, fine.responses.n_dofs / 2);
}

// Where no factor is at hand dual solutions come from the iteration, too, on refined meshes as well.
TEST(Goals, OfIteratedResponsesAreThoseOfTheFactor) {
  const auto shaft = fem_tests::eccentric_shaft(2);
  fem::RefinementCycle cycle;
  for (std::int32_t c = 0; c < 300; c += 11) cycle.cells.push_back(c);
  const Bent direct(shaft, {cycle}, fem::Solver::direct), iterated(shaft, {cycle}, fem::Solver::iterative);
  ASSERT_EQ(direct.responses.solver.used, fem::Solver::direct);
  ASSERT_EQ(iterated.responses.solver.used, fem::Solver::iterative) << iterated.responses.solver.reason;
  const auto goal = direct.goal();
  const auto expected = direct.model->goal_errors_Pa(direct.responses, {goal}).at(0),
             errors = iterated.model->goal_errors_Pa(iterated.responses, {goal}).at(0);
  const double largest = *std::max_element(expected.begin(), expected.end());
  for (std::size_t c = 0; c < expected.size(); ++c) ASSERT_NEAR(errors[c], expected[c], 1e-6 * largest);
}

TEST(Goals, OfAnotherModelAreRefused) {
  const Bent bent(fem_tests::eccentric_shaft(2), {});
  auto goal = bent.goal();
  goal.factors.pop_back();
  EXPECT_THROW(bent.model->goal_errors_Pa(bent.responses, {goal}), std::invalid_argument);
  goal = bent.goal();
  goal.parts[0].node = bent.responses.nodes.n;
  EXPECT_THROW(bent.model->goal_errors_Pa(bent.responses, {goal}), std::invalid_argument);
  auto others = bent.responses;
  others.nodes.n += 1;
  EXPECT_THROW(bent.model->goal_errors_Pa(others, {bent.goal()}), std::invalid_argument);
}

}  // namespace
