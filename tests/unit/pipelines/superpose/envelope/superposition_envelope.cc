/// Superposition against brute force, closed forms of the stress measures, and its bookkeeping.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

#include "pipelines/superpose/envelope/stress_shares.h"
#include "pipelines/superpose/envelope/superposition.h"
#include "pipelines/superpose/kernels/walked_factors.h"

namespace {

using pipelines::Stress;

struct Problem {
  pipelines::ChannelHistory loads;
  fem::UnitResponses responses;
};

/// Random unit stresses and a few harmonics over the cycle; sizes chosen to leave incomplete blocks and
/// batches.
Problem random_problem(std::size_t n_nodes, std::size_t n_channels, Eigen::Index n_instants) {
  Problem p;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (std::size_t k = 0; k < n_channels; ++k) {
    p.loads.channels.push_back({"port.c" + std::to_string(k), "N"});
    p.responses.channels.push_back("port.c" + std::to_string(k));
  }
  p.responses.nodes.n = n_nodes;
  for (std::size_t i = 0; i < n_nodes * n_channels * 6; ++i) p.responses.stress_Pa.push_back(normal(random));
  p.loads.effects = {"one", "two", "three"};
  for (int e = 0; e < 3; ++e) {
    Eigen::ArrayXXd part(Eigen::Index(n_channels), n_instants);
    for (Eigen::Index k = 0; k < part.rows(); ++k) {
      const double phase = normal(random), size = normal(random);
      for (Eigen::Index i = 0; i < n_instants; ++i)
        part(k, i) = size * std::cos(2 * M_PI * (1 + k % 3) * double(i) / double(n_instants) + phase);
    }
    p.loads.by_effect.push_back(part);
  }
  p.loads.values = p.loads.by_effect[0] + p.loads.by_effect[1] + p.loads.by_effect[2];
  return p;
}

TEST(Superposition, EnvelopeIsThatOfBruteForce) {
  const auto p = random_problem(37, 11, 101);
  const auto envelope = pipelines::envelope(p.loads, p.responses, 2);
  for (std::size_t node = 0; node < p.responses.nodes.n; ++node) {
    double von_mises = 0, principal = -1e300;
    for (Eigen::Index i = 0; i < 101; ++i) {
      const auto stress = pipelines::stress_at(p.responses, p.loads, node, i);
      von_mises = std::max(von_mises, pipelines::von_mises_Pa(stress));
      principal = std::max(principal, pipelines::largest_principal_Pa(stress));
    }
    // The walk orders its sums otherwise than this loop: round-off of eleven terms.
    EXPECT_NEAR(envelope.von_mises.value_Pa[node], von_mises, 1e-13 * von_mises);
    EXPECT_NEAR(envelope.principal.value_Pa[node], principal, 1e-13 * std::abs(principal));
    const auto at = pipelines::stress_at(p.responses, p.loads, node, envelope.von_mises.instant[node]);
    EXPECT_EQ(at, envelope.von_mises.stress_Pa[node]);
    EXPECT_NEAR(pipelines::largest_principal_Pa(envelope.principal.stress_Pa[node]), principal,
                1e-13 * std::abs(principal));
  }
}

// What may be taken over is of the same loads to the bit, in all that an envelope is made of.
TEST(Superposition, HistoriesAreTheSameOrNot) {
  const auto loads = random_problem(1, 5, 20).loads;
  const auto is_same = [&](const auto& change) {
    auto other = loads;
    change(other);
    return pipelines::have_same_values(loads, other);
  };
  EXPECT_TRUE(is_same([](auto& other) { other.body = "another"; }));
  EXPECT_FALSE(is_same([](auto& other) { other.values(3, 7) *= 1 + 1e-15; }));
  EXPECT_FALSE(is_same([](auto& other) { other.by_effect[2](0, 19) += 1e-15; }));
  EXPECT_FALSE(is_same([](auto& other) { other.by_effect.pop_back(); }));
  EXPECT_FALSE(is_same([](auto& other) { other.channels[4].name += "s"; }));
  EXPECT_FALSE(is_same([](auto& other) { other.effects[0] = "other"; }));
  EXPECT_FALSE(is_same([](auto& other) { other.values = other.values.leftCols(19).eval(); }));
}

// Compression everywhere: the largest principal stress is negative and must not be lost against padded
// instants of no load.
TEST(Superposition, PureCompressionKeepsItsSign) {
  auto p = random_problem(3, 1, 5);
  for (std::size_t node = 0; node < 3; ++node) {
    const Stress pressed{-1, -2, -3, 0, 0, 0};
    std::copy(pressed.begin(), pressed.end(), p.responses.stress_Pa.begin() + std::ptrdiff_t(6 * node));
  }
  p.loads.values << 5, 4, 3, 4, 5;
  p.loads.by_effect = {p.loads.values, 0 * p.loads.values, 0 * p.loads.values};
  const auto envelope = pipelines::envelope(p.loads, p.responses, 1);
  EXPECT_NEAR(envelope.principal.value_Pa[0], -3, 1e-14);
  EXPECT_EQ(envelope.principal.instant[0], 2);
  EXPECT_EQ(envelope.von_mises.instant[0], 0) << "the first of equal instants";
}

/// One node whose stress is the time factors themselves.
Problem given_stresses(const std::vector<Stress>& stresses) {
  auto p = random_problem(1, 6, Eigen::Index(stresses.size()));
  p.responses.stress_Pa.assign(36, 0.0);
  for (std::size_t c = 0; c < 6; ++c) p.responses.stress_Pa[7 * c] = 1;
  for (std::size_t i = 0; i < stresses.size(); ++i)
    for (std::size_t c = 0; c < 6; ++c) p.loads.values(Eigen::Index(c), Eigen::Index(i)) = stresses[i][c];
  p.loads.by_effect = {p.loads.values, 0 * p.loads.values, 0 * p.loads.values};
  return p;
}

// From tension along one axis to tension along two, the largest principal stress is told apart to 1e-11, in
// any order; at the end itself, where the angle's cosine is known to the root of the rounding, to 1e-7.
TEST(Superposition, PrincipalStressIsComparedAtEveryLodeAngle) {
  const std::size_t n = 61;
  for (const double end : {59.5, 60.0}) {
    const double gap = end < 60 ? 1e-11 : 1e-7;
    for (std::size_t winner = 0; winner < n; winner += 4) {
      std::vector<Stress> stresses;
      for (std::size_t i = 0; i < n; ++i) {
        const double lode = M_PI / 180 * end * double(i) / double(n - 1), third = 2 * M_PI / 3;
        const double size = (i == winner ? 1 + gap : 1) / std::cos(lode);
        stresses.push_back(
            {size * std::cos(lode + third), size * std::cos(lode), size * std::cos(lode - third), 0, 0, 0});
      }
      const auto p = given_stresses(stresses);
      EXPECT_EQ(pipelines::envelope(p.loads, p.responses, 1).principal.instant[0], std::int32_t(winner));
    }
  }
}

// A shaft that turns with its load: the stress of all instants is the same, and the first counts.
TEST(Superposition, OfSteadyStressTheFirstInstantCounts) {
  const auto p = given_stresses(std::vector<Stress>(50, Stress{3, -1, 2, 0.5, -4, 1}));
  const auto envelope = pipelines::envelope(p.loads, p.responses, 1);
  EXPECT_EQ(envelope.von_mises.instant[0], 0);
  EXPECT_EQ(envelope.principal.instant[0], 0);
}

/// All variants of the walk that this machine can run.
std::vector<pipelines::kernel::Walk*> walks_of_this_machine() {
  namespace kernel = pipelines::kernel;
  std::vector<kernel::Walk*> walks{&kernel::generic::walk};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) walks.push_back(&kernel::avx2::walk);
#endif
  if (&kernel::walk_for_this_machine() != walks.back()) walks.push_back(&kernel::walk_for_this_machine());
  return walks;
}

/// They differ by the order of rounding alone.
void expect_that_instruction_sets_agree(const Eigen::ArrayXXd& values, bool is_smooth) {
  namespace kernel = pipelines::kernel;
  const auto walks = walks_of_this_machine();
  const std::size_t n_nodes = kernel::batch - 1;
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> unit(n_nodes * std::size_t(values.rows()) * kernel::n_coordinates);
  for (double& value : unit) value = normal(random);
  const pipelines::WalkedFactors walked(values);
  const auto factors = walked.for_kernel();
  EXPECT_EQ(factors.knots.n_spans > 0, is_smooth);
  // Grows with the cosine, as the true one does; otherwise any will do.
  std::array<double, kernel::n_lode_terms> lode{0.75, 0.25};
  std::vector<double> room(kernel::room_of_walk(factors));
  std::vector<kernel::NodeMaximum> first(n_nodes), other(n_nodes);
  walks.front()(unit.data(), n_nodes, factors, lode.data(), room.data(), first.data());
  for (auto* walk : walks) {
    walk(unit.data(), n_nodes, factors, lode.data(), room.data(), other.data());
    for (std::size_t node = 0; node < n_nodes; ++node) {
      EXPECT_NEAR(other[node].von_mises_squared, first[node].von_mises_squared,
                  1e-13 * first[node].von_mises_squared);
      EXPECT_NEAR(other[node].principal, first[node].principal, 1e-13 * first[node].principal);
      EXPECT_EQ(other[node].von_mises_instant, first[node].von_mises_instant);
      EXPECT_EQ(other[node].principal_instant, first[node].principal_instant);
    }
  }
}

TEST(Superposition, InstructionSetsAgree) {
  std::mt19937 random(13);
  std::normal_distribution<double> normal;
  const Eigen::Index n_channels = 5, n_instants = 7 * pipelines::kernel::block - 3;
  expect_that_instruction_sets_agree(
      Eigen::ArrayXXd::NullaryExpr(n_channels, n_instants, [&] { return normal(random); }), false);
  expect_that_instruction_sets_agree(random_problem(1, n_channels, n_instants).loads.values, true);
}

TEST(Superposition, EffectSharesAddUpToOne) {
  const auto p = random_problem(20, 6, 50);
  const auto envelope = pipelines::envelope(p.loads, p.responses, 1);
  for (std::size_t node = 0; node < 20; ++node) {
    const auto exact = pipelines::shares_of_stress(pipelines::unit_stresses_at(p.responses, node), p.loads,
                                                   envelope.von_mises.instant[node])
                           .effects;
    double sum = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      sum += exact[e];
      EXPECT_EQ(envelope.effect_share[3 * node + e], float(exact[e])) << "single precision, rounded once";
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(Superposition, SameBitsWhateverTheThreads) {
  const auto p = random_problem(100, 7, 64);
  const auto one = pipelines::envelope(p.loads, p.responses, 1),
             three = pipelines::envelope(p.loads, p.responses, 3);
  EXPECT_EQ(one.von_mises.value_Pa, three.von_mises.value_Pa);
  EXPECT_EQ(one.principal.value_Pa, three.principal.value_Pa);
  EXPECT_EQ(one.effect_share, three.effect_share);
}

TEST(Superposition, NoLoadIsNoStressAndNoNaN) {
  auto p = random_problem(5, 4, 16);
  p.loads.values.setZero();
  for (auto& part : p.loads.by_effect) part.setZero();
  const auto envelope = pipelines::envelope(p.loads, p.responses, 1);
  for (std::size_t node = 0; node < 5; ++node) {
    EXPECT_EQ(envelope.von_mises.value_Pa[node], 0);
    EXPECT_EQ(envelope.principal.value_Pa[node], 0);
    EXPECT_EQ(envelope.effect_share[3 * node], 0);
  }
}

// One unit displacement per channel and direction tells which entry went where.
TEST(Superposition, DisplacementIsTheSumOverTheChannels) {
  auto p = random_problem(5, 4, 9);
  p.responses.displacement_m.resize(5 * 4 * 3);
  for (std::size_t i = 0; i < p.responses.displacement_m.size(); ++i)
    p.responses.displacement_m[i] = std::sqrt(2.0 + double(i));
  const auto displacement = pipelines::displacement_at(p.responses, p.loads, 6);
  ASSERT_EQ(displacement.size(), 15u);
  for (std::size_t node = 0; node < 5; ++node)
    for (std::size_t c = 0; c < 3; ++c) {
      double wanted = 0;
      for (std::size_t k = 0; k < 4; ++k)
        wanted += p.loads.values(Eigen::Index(k), 6) * std::sqrt(2.0 + double((node * 4 + k) * 3 + c));
      EXPECT_NEAR(displacement[3 * node + c], wanted, 1e-14 * 100);
    }
}

TEST(Superposition, ForeignChannelsAreRefused) {
  auto p = random_problem(2, 3, 4);
  p.responses.channels[1] = "other.c1";
  EXPECT_THROW(pipelines::envelope(p.loads, p.responses, 1), std::invalid_argument);
}

// Textbook states: uniaxial, pure shear (factor sqrt 3; a lost factor of two in shear would show here),
// hydrostatic.
TEST(StressMeasures, KnownStates) {
  EXPECT_NEAR(pipelines::von_mises_Pa({100, 0, 0, 0, 0, 0}), 100, 1e-12);
  for (std::size_t shear = 3; shear < 6; ++shear) {
    Stress s{};
    s[shear] = 100;
    EXPECT_NEAR(pipelines::von_mises_Pa(s), 100 * std::sqrt(3.0), 1e-11);
    EXPECT_NEAR(pipelines::largest_principal_Pa(s), 100, 1e-11);
  }
  EXPECT_EQ(pipelines::von_mises_Pa({7, 7, 7, 0, 0, 0}), 0);
  EXPECT_EQ(pipelines::largest_principal_Pa({-7, -7, -7, 0, 0, 0}), -7);
}

TEST(StressMeasures, LargestPrincipalIsTheLargestEigenvalue) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    Stress s;
    for (double& c : s) c = normal(random);
    Eigen::Matrix3d m;
    m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    const double wanted = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues()[2];
    // acos loses half the digits where two principal stresses meet; the cosine of a third gives them back.
    EXPECT_NEAR(pipelines::largest_principal_Pa(s), wanted, 1e-12 * m.norm());
  }
}

}  // namespace

// Channels of sizes from 1e-9 to 1e9, some of them sums of others, one a multiple, one zero: as many are
// independent as there were to begin with, and all follow from them.
TEST(IndependentChannels, CarryAllOthers) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const int n_independent : {1, 4, 12}) {
    const Eigen::Index n_channels = 2 * n_independent + 2, n_instants = 200;
    const auto draw = [&] { return normal(random); };
    const Eigen::MatrixXd basis = Eigen::MatrixXd::NullaryExpr(n_independent, n_instants, draw);
    Eigen::MatrixXd sums = Eigen::MatrixXd::NullaryExpr(n_channels, n_independent, draw);
    sums.row(1) = -3 * sums.row(0);
    sums.row(n_channels / 2).setZero();
    Eigen::ArrayXXd values = sums * basis;
    for (Eigen::Index k = 0; k < n_channels; ++k) values.row(k) *= std::pow(10, double(7 * k % 19) - 9);
    const auto found = pipelines::independent_channels(values);
    EXPECT_EQ(found.channels.size(), std::size_t(n_independent));
    Eigen::ArrayXXd of_independent(Eigen::Index(found.channels.size()), n_instants);
    for (std::size_t i = 0; i < found.channels.size(); ++i)
      of_independent.row(Eigen::Index(i)) = values.row(found.channels[i]);
    const Eigen::ArrayXXd again = (found.of_channel * of_independent.matrix()).array();
    for (Eigen::Index k = 0; k < n_channels; ++k)  // rounding of a dozen terms
      EXPECT_LE((again.row(k) - values.row(k)).abs().maxCoeff(), 1e-13 * values.row(k).matrix().norm()) << k;
  }
}

// A shaft without load, and one instant alone.
TEST(IndependentChannels, MayBeNoneOrOne) {
  EXPECT_TRUE(pipelines::independent_channels(Eigen::ArrayXXd::Zero(5, 7)).channels.empty());
  EXPECT_EQ(pipelines::independent_channels(Eigen::ArrayXXd::Constant(5, 1, 2.5)).channels.size(), 1u);
}
