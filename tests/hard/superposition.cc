// Sums whose terms cancel, and measures of stress that subtract equals. References: long double, and sums
// that are known whatever their terms.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "pipelines/judge/estimates/error_budget.h"
#include "pipelines/superpose/envelope/superposition.h"
#include "tests/hard/hard_case.h"
#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using pipelines::Stress, pipelines::unit_stress_at, pipelines::von_mises_of;

/// sqrt(I1^2 - 3 I2)
double naive_von_mises(const Stress& s) {
  const double I1 = s[0] + s[1] + s[2];
  const double I2 = s[0] * s[1] + s[1] * s[2] + s[2] * s[0] - s[3] * s[3] - s[4] * s[4] - s[5] * s[5];
  return std::sqrt(I1 * I1 - 3 * I2);
}

/// The largest root of the characteristic polynomial, by its invariants.
double naive_principal(const Stress& s) {
  const double I1 = s[0] + s[1] + s[2];
  const double I2 = s[0] * s[1] + s[1] * s[2] + s[2] * s[0] - s[3] * s[3] - s[4] * s[4] - s[5] * s[5];
  const double I3 = s[0] * s[1] * s[2] + 2 * s[3] * s[4] * s[5] - s[0] * s[4] * s[4] - s[1] * s[5] * s[5] -
                    s[2] * s[3] * s[3];
  const double q = I1 * I1 - 3 * I2;
  const double angle = std::acos((2 * I1 * I1 * I1 - 9 * I1 * I2 + 27 * I3) / (2 * q * std::sqrt(q)));
  return I1 / 3 + 2.0 / 3 * std::sqrt(q) * std::cos(angle / 3);
}

using Matrix = Eigen::Matrix<long double, 3, 3>;

Matrix matrix(const Stress& s) {
  Matrix m;
  m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return m;
}

/// Tensors with these principal stresses, turned at random.
std::vector<Stress> turned_tensors(const Eigen::Vector3d& principal) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  std::vector<Stress> tensors;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(normal(generator), normal(generator), normal(generator), normal(generator))
            .normalized()
            .toRotationMatrix();
    const Eigen::Matrix3d m = turn * principal.asDiagonal() * turn.transpose();
    tensors.push_back({m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)});
  }
  return tensors;
}

void worsen(double& worst, double error) {
  if (!(error <= worst)) worst = error;  // NaN stays
}

/// A body's loads at one instant.
pipelines::BodyLoads loads_at_one_instant(const std::vector<std::vector<double>>& by_effect) {
  pipelines::BodyLoads loads;
  const auto n = Eigen::Index(by_effect[0].size());
  loads.history.values = Eigen::ArrayXXd::Zero(n, 1);
  for (const auto& effect : by_effect) {
    loads.history.by_effect.push_back(Eigen::Map<const Eigen::ArrayXd>(effect.data(), n));
    loads.history.values += loads.history.by_effect.back();
  }
  loads.unit_loads.resize(std::size_t(n));
  return loads;
}

/// What is off, over what is told: by all that the calculation states of sums, and without `cancellation`.
struct Told {
  double ours = 0, naive = 0, largest_share = 0;

  void add(double off_Pa, const pipelines::ErrorBudget& budget, double value_Pa) {
    const double told_Pa = budget.of("linear_solver") + budget.of("cancellation");
    worsen(ours, off_Pa == 0 ? 0 : off_Pa / told_Pa);
    worsen(naive, off_Pa == 0 ? 0 : off_Pa / budget.of("linear_solver"));
    largest_share = std::max(largest_share, told_Pa / value_Pa);
  }
};

}  // namespace

// Differences of the components have all digits: a few roundings.
TEST(HardSuperposition, NearlyHydrostaticStress) {
  double ours = 0, naive = 0;
  for (const auto& s : turned_tensors({1e8, 1e8 + 0.01, 1e8 - 0.02})) {
    const Matrix m = matrix(s), deviator = m - Matrix::Identity() * (m.trace() / 3);
    const long double wanted = std::sqrt(1.5L * deviator.squaredNorm());
    worsen(ours, hard_cases::relative(pipelines::von_mises_Pa(s), wanted));
    worsen(naive, hard_cases::relative(naive_von_mises(s), wanted));
  }
  hard_cases::check({"superposition", "von Mises beside a pressure 1e10 times as large",
                     "its square is the rest of 1e16 and 1e16", "sqrt(I1^2 - 3 I2)", naive, ours, 1e-14});
}

// Two equal principal stresses: the angle's cosine is 1 or -1, rounding may pass it, and a small change of it
// is the root of that in the angle.
TEST(HardSuperposition, EqualPrincipalStresses) {
  for (const bool largest_twice : {false, true}) {
    double ours = 0, naive = 0;
    for (const auto& s :
         turned_tensors(largest_twice ? Eigen::Vector3d(2, 2, -1) : Eigen::Vector3d(2, -1, -1))) {
      const long double wanted = Eigen::SelfAdjointEigenSolver<Matrix>(matrix(s)).eigenvalues()[2];
      worsen(ours, hard_cases::relative(pipelines::largest_principal_Pa(s), wanted));
      worsen(naive, hard_cases::relative(naive_principal(s), wanted));
    }
    hard_cases::check({"superposition",
                       largest_twice ? "largest principal stress twice" : "smallest principal stress twice",
                       "the cosine of the angle is 1 but for rounding, or more",
                       "the characteristic polynomial's root", naive, ours, 1e-15});
  }
}

// 0.1 + 0.2 - 0.3 + 3e-11 of three effects in one channel: the sum's own rounding is 1e-6 of it.
TEST(HardSuperposition, EffectsThatCancelAreTold) {
  fem::UnitResponses responses;
  responses.nodes.n = 1;
  responses.nodes.xyz_m = {0, 0, 0};
  responses.channels = {"seat.fx"};
  responses.stress_Pa = {1, 0, 0, 0, 0, 0};
  const auto loads = loads_at_one_instant({{0.1}, {0.2}, {-0.3}, {3e-11}});
  const double value = std::abs(loads.history.values(0, 0));
  Told told;
  told.add(std::abs(value - 3e-11), self_estimate({{{0, 1.0}}, 0}, responses, loads, {}, 0), value);
  EXPECT_LT(told.largest_share, 1e-4) << "not much more than what it is off by";
  hard_cases::check({"superposition", "effects that cancel to 1e-10: what is off over what is told",
                     "a sum of few digits looks like any other", "residual times the peak", told.naive,
                     told.ours, 1});
}

namespace {

/// Channels whose responses add up to nothing, and one more, which is the answer.
struct CancellingChannels {
  std::string name;
  fem::Body body;
  std::vector<fem::UnitLoad> loads;
  std::vector<double> factors;  ///< of all but the last
};

/// A rod sixty times longer than thick: all of it carried along sideways is not strained, so its two halves
/// bend it against each other.
CancellingChannels carried_halves() {
  verification::Block block;
  block.cells = {1, 1, 40};
  block.map = [](const verification::Point& q) {
    return verification::Point(0.01 * (q[0] - 0.5), 0.01 * (q[1] - 0.5), 0.6 * q[2]);
  };
  block.volume = [](const std::array<int, 3>& cell) { return cell[2] < 20 ? 7 : 8; };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  body.material = {206e9, 0.3, 7850};
  using Field = fem::BodyForce::Field;
  return {"two halves of a slender rod",
          body,
          {{"volume.left.ay", fem::BodyForce{Field::translation_y, {7}}},
           {"volume.right.ay", fem::BodyForce{Field::translation_y, {8}}},
           {"end.torque", verification::on_face(verification::end_3, {0, 0, 0.6},
                                                fem::SurfaceResultant::Component::torque)}},
          {1, 1}};
}

/// At every node, with the answer 1e10 times smaller than what cancels.
Told told_of(const CancellingChannels& c, fem::Solver solver) {
  const auto responses =
      fem::Model(c.body).unit_responses(c.loads, {}, fem::Recovery::patch, {}, {solver, 1e-10, 100});
  EXPECT_EQ(responses.solver.used, solver) << responses.solver.reason;
  const auto at = [&](std::size_t node) { return unit_stress_at(responses, {{{node, 1.0}}, 0}); };
  double cancelling_Pa = 0, answer_Pa = 0;
  for (std::size_t i = 0; i < responses.nodes.n; ++i) {
    cancelling_Pa = std::max(cancelling_Pa, pipelines::von_mises_Pa(at(i).front()));
    answer_Pa = std::max(answer_Pa, pipelines::von_mises_Pa(at(i).back()));
  }
  auto factors = c.factors;
  factors.push_back(1e-10 * cancelling_Pa / answer_Pa);
  const auto loads = loads_at_one_instant({factors});
  Told told;
  for (std::size_t i = 0; i < responses.nodes.n; ++i) {
    const auto unit = at(i);
    const double value = von_mises_of(unit, loads.history.values.col(0));
    const double exact = pipelines::von_mises_Pa(unit.back()) * factors.back();
    if (exact < 1e-11 * cancelling_Pa) continue;  // no peak
    told.add(std::abs(value - exact), self_estimate({{{i, 1.0}}, 0}, responses, loads, c.body.material, 0),
             value);
  }
  std::printf("%s: residual %g, rounding %g, told up to %g of the value\n", c.name.c_str(),
              responses.residual, responses.solver.rounding, told.largest_share);
  return told;
}

}  // namespace

// What is left of channels that cancel has the solver's error of all of them.
TEST(HardSuperposition, ChannelsThatCancelAreTold) {
  const auto channels = carried_halves();
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative}) {
    const auto told = told_of(channels, solver);
    hard_cases::check({"superposition",
                       channels.name + " that cancel to 1e-10, " +
                           (solver == fem::Solver::direct ? "factorised" : "iterated") +
                           ": what is off over what is told",
                       "the solver's error is that of the channels, not of their rest",
                       "residual times the peak", told.naive, told.ours, 1});
  }
}
