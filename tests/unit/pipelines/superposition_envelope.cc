/// Superposition against brute force, closed forms of the stress measures, and its bookkeeping.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "pipelines/superposition.h"

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

TEST(Superposition, EffectSharesAddUpToOne) {
  const auto p = random_problem(20, 6, 50);
  const auto envelope = pipelines::envelope(p.loads, p.responses, 1);
  for (std::size_t node = 0; node < 20; ++node) {
    double sum = 0;
    for (std::size_t e = 0; e < 3; ++e) sum += envelope.effect_share[3 * node + e];
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
