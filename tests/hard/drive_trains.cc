// Trains that take all digits: stiff beside soft, equal frequencies, resonances, a million steps. References:
// bisection and dynamic stiffnesses in long double, closed forms.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinetics/values/machine_refused.h"
#include "tests/hard/hard_case.h"
#include "tests/unit/kinetics/torsion/trains.h"

namespace {

using kinetics::DriveTrain;

double size_of(const kinetics::TrainInertia& inertia) {
  return inertia.inertia_kg_m2;
}

/// Stiffness matrix of a train of one shaft line.
Eigen::MatrixXd stiffness_matrix(const DriveTrain& train) {
  const auto n = Eigen::Index(train.inertias.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  const auto index = [&](const std::string& name) {
    Eigen::Index i = 0;
    while (train.inertias[std::size_t(i)].name != name) ++i;
    return i;
  };
  for (const auto& e : train.elements) {
    const auto a = index(e.first), b = index(e.second);
    K(a, a) += *e.stiffness_N_m_rad, K(b, b) += *e.stiffness_N_m_rad;
    K(a, b) -= *e.stiffness_N_m_rad, K(b, a) -= *e.stiffness_N_m_rad;
  }
  return K;
}

Eigen::VectorXd inertia_vector(const DriveTrain& train) {
  Eigen::VectorXd J(Eigen::Index(train.inertias.size()));
  for (Eigen::Index i = 0; i < J.size(); ++i) J[i] = size_of(train.inertias[std::size_t(i)]);
  return J;
}

/// Largest relative error of the elastic frequencies, ours and those of eigenvalues of J^-1/2 K J^-1/2.
struct FrequencyErrors {
  double naive = 0, ours = 0, lowest_over_highest = 0;
};
FrequencyErrors frequency_errors(const DriveTrain& train) {
  const auto exact = trains::counted_frequencies(train);
  const auto modes = natural_modes(train, kinetics::Shapes::none);
  const Eigen::VectorXd weight = inertia_vector(train).cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd squares = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                                      weight.asDiagonal() * stiffness_matrix(train) * weight.asDiagonal())
                                      .eigenvalues();
  FrequencyErrors errors;
  for (std::size_t k = 1; k < exact.size(); ++k) {
    const double naive = hard_cases::relative(std::sqrt(squares[Eigen::Index(k)]), exact[k]);
    if (!(naive <= errors.naive)) errors.naive = naive;  // NaN stays
    errors.ours =
        std::max(errors.ours, hard_cases::relative(modes.frequency_rad_s[Eigen::Index(k)], exact[k]));
  }
  errors.lowest_over_highest = double(exact[1] / exact.back());
  return errors;
}

/// Undamped response of a chain at its first inertia to a unit torque there: dynamic stiffnesses from the far
/// end, which never subtract a stiffness.
long double chain_response(const std::vector<double>& J, const std::vector<double>& C, long double w) {
  long double seen = -w * w * J.back();
  for (std::size_t i = C.size(); i-- > 0;) seen = C[i] * seen / (C[i] + seen) - w * w * J[i];
  return 1 / seen;
}

double naive_response(const DriveTrain& train, double w) {
  Eigen::MatrixXd D = stiffness_matrix(train);
  D.diagonal() -= w * w * inertia_vector(train);
  return D.partialPivLu().solve(Eigen::VectorXd::Unit(D.rows(), 0))[0];
}

}  // namespace

// Ten roundings per element.
TEST(HardTrains, FrequenciesOfStiffAndSoftShafts) {
  const auto chain = frequency_errors(trains::chain({1, 2, 3, 4}, {1e-2, 1e10, 1e-1}));
  hard_cases::check({"drive trains", "stiffnesses 1 : 1e12 in a chain",
                     "squares of frequencies differ by 1e12", "eigenvalues of the stiffness matrix",
                     chain.naive, chain.ours, 1e-14});
  auto star = trains::chain({1, 2, 3, 4, 5}, {1e-2, 1e10, 1e-1, 1e9});
  for (auto& element : star.elements) element.first = "J0";
  const auto tree = frequency_errors(star);
  hard_cases::check({"drive trains", "stiffnesses 1 : 1e12 in a tree",
                     "squares of frequencies differ by 1e12", "eigenvalues of the stiffness matrix",
                     tree.naive, tree.ours, 1e-14});
  const auto low = frequency_errors(trains::chain({1, 1, 1, 1}, {1e10, 1e-10, 1e10}));
  EXPECT_LT(low.lowest_over_highest, 1e-10);
  hard_cases::check({"drive trains", "smallest frequency 1e-10 of the largest",
                     "its square is 1e-20 of the largest, below rounding",
                     "eigenvalues of the stiffness matrix", low.naive, low.ours, 1e-14});
}

// Eight equal branches on a hub: one frequency sqrt(C / J) seven times. Modes of one frequency must still be
// independent motions. A hundred roundings for vectors of nine entries.
TEST(HardTrains, ClusterOfEqualFrequencies) {
  constexpr int n = 8;
  auto train = trains::chain(std::vector<double>(n + 1, 2), std::vector<double>(n, 200));
  train.inertias[0].inertia_kg_m2 = 0.1;
  for (auto& element : train.elements) element.first = "J0";
  const auto modes = natural_modes(train);
  const Eigen::VectorXd J = inertia_vector(train);
  const auto dependence = [&](Eigen::MatrixXd shapes) {
    for (auto column : shapes.colwise()) column /= std::sqrt((J.array() * column.array().square()).sum());
    const Eigen::MatrixXd gram = shapes.transpose() * J.asDiagonal() * shapes;
    return (gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
  };
  double off = 0;
  for (int k = 1; k < n; ++k) off = std::max(off, hard_cases::relative(modes.frequency_rad_s[k], 10));
  hard_cases::check(
      {"drive trains", "one frequency seven times", "every turn within the cluster is a mode too",
       "eigenvectors of J^-1 K",
       dependence(Eigen::EigenSolver<Eigen::MatrixXd>(J.cwiseInverse().asDiagonal() * stiffness_matrix(train))
                      .eigenvectors()
                      .real()),
       std::max(off, dependence(modes.reduced_shape.matrix())), 1e-13});
}

// 1e-9 beside a resonance the response takes nine digits of the frequency: ours has 16 - 9 of its own left.
TEST(HardTrains, BesideAnUndampedResonanceBehindAStiffCoupling) {
  const std::vector<double> J{1, 1, 1}, C{1e8, 2};
  auto train = trains::chain(J, C);
  const double w = double(trains::counted_frequencies(train)[1] * (1 + 1e-9L));
  train.excitations = {trains::harmonic("J0", 1, w)};
  const auto response = forced_response(train);
  const auto exact = chain_response(J, C, w);
  hard_cases::check({"drive trains", "1e-9 beside an undamped resonance, stiffnesses 1 : 5e7",
                     "the response divides by 1e-9 of the soft shaft's stiffness", "solve (K - w^2 J) q = M",
                     hard_cases::relative(naive_response(train, w), exact),
                     hard_cases::relative(response.harmonics.at(0).angle_rad[0].real(), exact), 1e-6});
  EXPECT_FALSE(response.warnings.empty()) << "it is told";
}

// There is no steady state: no number is right.
TEST(HardTrains, AnUndampedResonanceIsRefused) {
  auto train = trains::chain({5, 11, 22}, {1e5, 2e5});
  const double w = natural_modes(train).frequency_rad_s[2];
  train.excitations = {trains::harmonic("J0", 1, w)};
  double ours = std::numeric_limits<double>::infinity();
  try {
    forced_response(train);
  } catch (const kinetics::MachineRefused&) {
    ours = 0;
  }
  const double naive = std::isfinite(naive_response(train, w)) ? std::numeric_limits<double>::infinity() : 0;
  hard_cases::check({"drive trains", "at an undamped resonance", "there is no steady state",
                     "solve (K - w^2 J) q = M: a finite angle", naive, ours, 0});
}

// Rounding in a million steps: 1e6 times 1e-16.
TEST(HardTrains, EnergyOfAMillionSteps) {
  auto train = trains::chain({1, 2}, {800});
  train.inertias[0].held = true;  // w = 20
  kinetics::TransientRun run;
  run.time_step_s = 5e-3;
  run.n_steps = 1'000'000;
  run.store_every = 100'000;
  run.with_excitations = false;
  run.angle_rad = Eigen::Array2d(0, 1);
  const auto found = transient(train, run);
  const Eigen::ArrayXd energy = found.kinetic_J + found.potential_J;
  double angle = 1, speed = 0;
  for (long i = 0; i < run.n_steps; ++i) {  // Runge and Kutta, fourth order
    const double h = run.time_step_s;
    std::array<double, 4> v{}, a{};
    for (std::size_t s = 0; s < 4; ++s) {
      const double part = s == 0 ? 0 : s == 3 ? h : h / 2;
      v[s] = speed + (s == 0 ? 0 : part * a[s - 1]);
      a[s] = -400 * (angle + (s == 0 ? 0 : part * v[s - 1]));
    }
    angle += h / 6 * (v[0] + 2 * v[1] + 2 * v[2] + v[3]);
    speed += h / 6 * (a[0] + 2 * a[1] + 2 * a[2] + a[3]);
  }
  hard_cases::check({"drive trains", "energy of an undamped train after a million steps",
                     "what one step loses adds up", "Runge and Kutta's method of fourth order",
                     hard_cases::relative(speed * speed + 400 * angle * angle, 400),
                     double((energy / 400 - 1).abs().maxCoeff()), 1e-9});
}

// A free train that a constant torque speeds up, with the twist that this takes from the start: the torque in
// the shaft stays M J2 / (J1 + J2), while the angles grow to 5e7 rad. A million roundings of the twist:
// 1e-10.
TEST(HardTrains, TorqueOfATrainThatTurnsForLong) {
  const double M = 2.1, C = 1e6, h = 1e-2, torque = M * 3 / 4;
  auto train = trains::chain({1, 3}, {C});
  kinetics::TransientRun run;
  run.time_step_s = h;
  run.n_steps = 1'000'000;
  run.store_every = run.n_steps;
  run.with_excitations = false;
  run.loads = {{"J0", [&](double) { return M; }}};
  run.angle_rad = Eigen::Array2d(torque / C, 0);
  const auto found = transient(train, run);
  double phi[2] = {torque / C, 0}, v[2] = {0, 0};
  for (long i = 0; i < run.n_steps; ++i) {  // the same method, the twist from the angles
    const double twist = phi[0] - phi[1], rate = v[0] - v[1];
    const double mean_rate = (rate + h / 2 * (M - 4.0 / 3 * C * twist)) / (1 + h * h / 3 * C);
    const double T = C * (twist + h / 2 * mean_rate);
    const double step[2] = {h * (M - T), h * T / 3};
    for (int k = 0; k < 2; ++k) phi[k] += h * (v[k] + step[k] / 2), v[k] += step[k];
  }
  hard_cases::check({"drive trains", "torque of a train that turns for a million steps",
                     "the twist is 1e-13 of the angle", "twist as the difference of the angles",
                     hard_cases::relative(C * (phi[0] - phi[1]), torque),
                     hard_cases::relative(found.motion.torque_Nm(0, 1), torque), 1e-9});
}
