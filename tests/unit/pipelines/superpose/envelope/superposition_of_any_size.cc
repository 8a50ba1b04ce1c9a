/// Loads whose squares are no numbers: superposition is linear over all of them, and of nothing it makes
/// nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pipelines/superpose/envelope/superposition.h"

namespace {

using pipelines::Stress;

/// Two nodes, two channels, three instants, two effects.
struct SizedProblem {
  pipelines::ChannelHistory loads;
  fem::UnitResponses responses;
};

SizedProblem problem(double size) {
  SizedProblem p;
  p.loads.channels = {{"a.fx", "N"}, {"a.fy", "N"}};
  p.responses.channels = {"a.fx", "a.fy"};
  p.responses.nodes.n = 2;
  for (int i = 0; i < 24; ++i) p.responses.stress_Pa.push_back(std::cos(3.7 * i) * 1e3);
  p.loads.effects = {"one", "two"};
  Eigen::ArrayXXd one(2, 3), two(2, 3);
  one << 1, 2, -3, 0.5, 4, 1;
  two << 0, 1, 2, -2, 0.25, 3;
  p.loads.by_effect = {one * size, two * size};
  p.loads.values = p.loads.by_effect[0] + p.loads.by_effect[1];
  return p;
}

// Powers of two change no bit.
TEST(SuperpositionOfAnySize, IsLinearBitForBit) {
  const auto usual_problem = problem(1);
  const auto usual = pipelines::envelope(usual_problem.loads, usual_problem.responses, 1);
  for (const int exponent : {-600, -498, 498, 600}) {
    const auto p = problem(std::ldexp(1.0, exponent));
    const auto e = pipelines::envelope(p.loads, p.responses, 1);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(std::ldexp(e.von_mises.value_Pa[i], -exponent), usual.von_mises.value_Pa[i]) << exponent;
      EXPECT_EQ(std::ldexp(e.principal.value_Pa[i], -exponent), usual.principal.value_Pa[i]) << exponent;
      for (std::size_t c = 0; c < 6; ++c)
        EXPECT_EQ(std::ldexp(e.von_mises.stress_Pa[i][c], -exponent), usual.von_mises.stress_Pa[i][c]);
    }
    EXPECT_EQ(e.von_mises.instant, usual.von_mises.instant);
    EXPECT_EQ(e.principal.instant, usual.principal.instant);
    EXPECT_EQ(e.effect_share, usual.effect_share);
  }
}

TEST(SuperpositionOfAnySize, OfNothingIsNothing) {
  const auto p = problem(0);
  const auto e = pipelines::envelope(p.loads, p.responses, 1);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(e.von_mises.value_Pa[i], 0);
    EXPECT_EQ(e.principal.value_Pa[i], 0);
  }
  for (const double share : e.effect_share) EXPECT_EQ(share, 0);
}

// Uniaxial tension: both measures are the tension itself. 4 eps: a square root and a cosine.
TEST(SuperpositionOfAnySize, MeasuresOfStressAreHomogeneous) {
  for (const double s : {1e-300, 1e-200, 1e-150, 1.0, 1e150, 1e200, 1e300}) {
    EXPECT_NEAR(pipelines::von_mises_Pa({0, 0, s, 0, 0, 0}), s, 1e-15 * s);
    EXPECT_NEAR(pipelines::largest_principal_Pa({0, 0, s, 0, 0, 0}), s, 1e-15 * s);
    EXPECT_NEAR(pipelines::von_mises_Pa({0, 0, 0, s, 0, 0}), std::sqrt(3) * s, 1e-15 * s);
    EXPECT_NEAR(pipelines::largest_principal_Pa({0, 0, 0, 0, -s, 0}), s, 1e-15 * s);
  }
}

TEST(SuperpositionOfAnySize, WhatIsNotFiniteStaysSo) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(std::isfinite(pipelines::von_mises_Pa({infinite, 0, 0, 0, 0, 0})));
}

}  // namespace
