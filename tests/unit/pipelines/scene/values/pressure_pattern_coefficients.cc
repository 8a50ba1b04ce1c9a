/// Coefficients of pressure patterns against quadrature.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "pipelines/scene/values/pressure_pattern.h"

namespace {

using pipelines::pattern_coefficient;
using pipelines::PressurePattern;
using Shape = PressurePattern::Kind;

constexpr double one_degree = M_PI / 180;

/// Five Gauss points on each of 400 pieces: exact to (n h)^10, h = a / 200, far below round-off for n <= 16.
double integral(const std::function<double(double)>& f, double from, double to) {
  constexpr std::array<double, 5> x{-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                    0.9061798459386640},
      w{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  constexpr int n = 400;
  const double half = (to - from) / n / 2;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (std::size_t g = 0; g < 5; ++g) sum += w[g] * f(from + (2 * i + 1 + x[g]) * half) * half;
  return sum;
}

/// Of any size, as pressure_pattern.h defines its kinds; 0 < |t| < half angle.
double shape(const PressurePattern& pattern, double t) {
  return pattern.kind == Shape::uniform ? 1 : std::cos(t) - std::cos(pattern.half_angle_rad);
}

std::string name_of(const testing::TestParamInfo<PressurePattern>& info) {
  return std::string(info.param.kind == Shape::cosine ? "cosine" : "uniform") +
         std::to_string(std::lround(info.param.half_angle_rad / one_degree));
}

class Pattern : public testing::TestWithParam<PressurePattern> {};

// p = sum of p_n cos(n t): p_n = (1/pi) integral of p cos(n t), half of it for n = 0.
TEST_P(Pattern, HasTheCoefficientsOfItsValues) {
  const auto& pattern = GetParam();
  const double a = pattern.half_angle_rad;
  const auto harmonic = [&](int n) {
    return integral([&](double t) { return shape(pattern, t) * std::cos(n * t); }, -a, a) *
           (n == 0 ? 0.5 : 1);
  };
  for (int n = 0; n <= 16; ++n)
    // Round-off of p_n / p_1, both sums of terms of size a: relative to p_1 = a^3 / pi for small a.
    EXPECT_NEAR(pattern_coefficient(pattern, n), harmonic(n) / harmonic(1), 1e-11) << "harmonic " << n;
  EXPECT_EQ(pattern_coefficient(pattern, 1), 1);
}

INSTANTIATE_TEST_SUITE_P(angles, Pattern,
                         testing::Values(PressurePattern{Shape::cosine, 90 * one_degree},
                                         PressurePattern{Shape::cosine, 30 * one_degree},
                                         PressurePattern{Shape::cosine, 60 * one_degree},
                                         PressurePattern{Shape::cosine, 120 * one_degree},
                                         PressurePattern{Shape::cosine, 170 * one_degree},
                                         PressurePattern{Shape::cosine, 180 * one_degree},
                                         PressurePattern{Shape::uniform, 30 * one_degree},
                                         PressurePattern{Shape::uniform, 90 * one_degree},
                                         PressurePattern{Shape::uniform, 150 * one_degree}),
                         name_of);

// coupling.md section 1: p = p0 [1/pi + cos(t)/2 + (2/(3 pi)) cos 2t - (2/(15 pi)) cos 4t + ...].
TEST(PressurePattern, HalfCosineIsTheTextbooks) {
  const PressurePattern half_cosine;
  EXPECT_NEAR(pattern_coefficient(half_cosine, 0), 2 / M_PI, 1e-15);
  EXPECT_NEAR(pattern_coefficient(half_cosine, 2), 4 / (3 * M_PI), 1e-15);
  EXPECT_NEAR(pattern_coefficient(half_cosine, 4), -4 / (15 * M_PI), 1e-15);
  for (const int odd : {3, 5, 7, 63}) EXPECT_EQ(pattern_coefficient(half_cosine, odd), 0) << odd;
}

// A pressure all round, 1 + cos t, has two harmonics.
TEST(PressurePattern, AllRoundHasTwoHarmonics) {
  const PressurePattern all_round{Shape::cosine, M_PI};
  EXPECT_NEAR(pattern_coefficient(all_round, 0), 1, 1e-14);
  for (int n = 2; n < 9; ++n) EXPECT_EQ(pattern_coefficient(all_round, n), 0) << n;
}

// A belt's p_n / p_1 = sin(n a) / (n sin a), which vanishes where n a is a multiple of 180 degrees: n = 3, 6,
// 9 of 60 degrees, 4, 8 of 45, 5, 10 of 36, the even ones of 90.
TEST(PressurePattern, UniformIsASeriesOfSincs) {
  for (const int half : {36, 45, 60, 72, 90, 150})
    for (int n = 2; n < 65; ++n) {
      const double a = half * one_degree, c = pattern_coefficient({Shape::uniform, a}, n);
      EXPECT_NEAR(c, std::sin(n * a) / (n * std::sin(a)), 1e-14) << half << ' ' << n;
      if (n * half % 180 == 0) {
        EXPECT_EQ(c, 0) << half << " " << n;
      }
    }
}

// The sum of the harmonics is the pressure: to 1 / n of a cosine's, whose kinks leave coefficients like 1 /
// n^2.
TEST(PressurePattern, PressureIsTheSumOfTheHarmonics) {
  for (const double half : {30, 60, 90, 150}) {
    const PressurePattern pattern{Shape::cosine, half * one_degree};
    for (const double t : {-100.0, 0.0, 20.0, 55.0, 170.0, 340.0}) {
      double sum = 0;
      for (int n = 0; n < 2000; ++n) sum += pattern_coefficient(pattern, n) * std::cos(n * t * one_degree);
      EXPECT_NEAR(pipelines::pattern_pressure(pattern, t * one_degree), sum, 2e-3) << half << ' ' << t;
    }
  }
  // pi / (2 sin a) within a belt's arc.
  EXPECT_NEAR(pipelines::pattern_pressure({Shape::uniform, 60 * one_degree}, 0.5), M_PI / std::sqrt(3),
              1e-14);
  EXPECT_EQ(pipelines::pattern_pressure({Shape::uniform, 60 * one_degree}, 1.1), 0);
}

// All round is the widest contact; a uniform pressure stays short of it, where it has no resultant.
TEST(PressurePattern, IsWidenedAtMostAllRound) {
  PressurePattern pattern;
  pattern.half_angle_rad = 160 * one_degree;
  EXPECT_EQ(pipelines::half_angles_around(pattern).most_rad, M_PI);
  EXPECT_NEAR(pipelines::half_angles_around(pattern).least_rad, 120 * one_degree, 1e-15);
  pattern.kind = Shape::uniform;
  EXPECT_NEAR(pipelines::half_angles_around(pattern).most_rad, 170 * one_degree, 1e-15);
}

// What is solved: the pattern's own harmonics; where a seat is felt those that it has not, next to unloaded,
// and the second and third of one that stops at the mean pressure.
TEST(PressureModel, SolvesWhatThePatternHasNot) {
  pipelines::PressureModel model;
  for (const int n : {1, 3, 5, 6}) EXPECT_EQ(solved_coefficient(model, n), 0) << n;
  EXPECT_EQ(solved_coefficient(model, 2), pattern_coefficient({}, 2));
  model.solves_missing = true;
  EXPECT_EQ(solved_coefficient(model, 3), pipelines::missing_coefficient);
  EXPECT_EQ(solved_coefficient(model, 4), pattern_coefficient({}, 4));
  for (const int n : {1, 5}) EXPECT_EQ(solved_coefficient(model, n), 0) << n;
  model.highest_harmonic = 0;
  for (const int n : {2, 3}) EXPECT_EQ(solved_coefficient(model, n), pipelines::missing_coefficient) << n;
  EXPECT_EQ(solved_coefficient(model, 4), 0);
  EXPECT_EQ(solved_coefficient(model, 0), pattern_coefficient({}, 0));
}

TEST(PressurePattern, RefusesWhatHasNoResultant) {
  EXPECT_THROW(pattern_coefficient({Shape::cosine, 0}, 2), std::invalid_argument);
  EXPECT_THROW(pattern_coefficient({Shape::cosine, 3.2}, 2), std::invalid_argument);
  EXPECT_THROW(pattern_coefficient({Shape::uniform, M_PI}, 0), std::invalid_argument);
  EXPECT_THROW(pattern_coefficient({}, -1), std::invalid_argument);
  EXPECT_THROW(pattern_coefficient({Shape::cosine, std::nan("")}, 2), std::invalid_argument);
}

}  // namespace
