/// Coefficients of pressure patterns against quadrature, and what is left out beyond the highest harmonic.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "pipelines/scene/pressure_pattern.h"

namespace {

using pipelines::pattern_coefficient;
using pipelines::pattern_value;
using pipelines::PressurePattern;
using Shape = PressurePattern::Kind;

constexpr double degree = M_PI / 180;

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

std::string name_of(const testing::TestParamInfo<PressurePattern>& info) {
  return std::string(info.param.kind == Shape::cosine ? "cosine" : "uniform") +
         std::to_string(std::lround(info.param.half_angle_rad / degree));
}

class Pattern : public testing::TestWithParam<PressurePattern> {};

// p = sum of c_n cos(n t), with p_1 = 1: c_n = (1/pi) integral of p cos(n t), half of it for n = 0.
TEST_P(Pattern, HasTheCoefficientsOfItsValues) {
  const auto& pattern = GetParam();
  const double a = pattern.half_angle_rad;
  for (int n = 0; n <= 16; ++n) {
    const auto product = [&](double t) { return pattern_value(pattern, t) * std::cos(n * t); };
    const double wanted = integral(product, -a, a) / M_PI * (n == 0 ? 0.5 : 1);
    // Round-off of p_n / p_1, both sums of terms of size a: relative to p_1 = a^3 / pi for small a.
    EXPECT_NEAR(pattern_coefficient(pattern, n), wanted, 1e-11) << "harmonic " << n;
  }
  EXPECT_EQ(pattern_coefficient(pattern, 1), 1);
}

// One unit of n = 1 is one unit of force whatever the rest: the resultant of the whole pattern along t = 0.
TEST_P(Pattern, CarriesOneUnitOfForceOnItsArc) {
  const auto& pattern = GetParam();
  const double a = pattern.half_angle_rad;
  const auto along = [&](double t) { return pattern_value(pattern, t) * std::cos(t) / M_PI; };
  EXPECT_NEAR(integral(along, -a, a), 1, 1e-12);
  for (const double outside : {a + 1e-9, M_PI - 1e-12, -a - 1e-9, a + 2 * M_PI + 1e-9})
    if (a < 3.1) {
      EXPECT_EQ(pattern_value(pattern, outside), 0) << outside;
    }
  EXPECT_NEAR(pattern_value(pattern, 0.3 * a), pattern_value(pattern, -0.3 * a + 2 * M_PI), 1e-13);
}

// Parseval on the circle: mean square of the pattern less what the harmonics kept hold.
TEST_P(Pattern, TruncationIsWhatTheHarmonicsLeave) {
  const auto& pattern = GetParam();
  const double a = pattern.half_angle_rad;
  const auto square = [&](double t) { return std::pow(pattern_value(pattern, t), 2); };
  const double whole = integral(square, -a, a) / (2 * M_PI);
  double kept = 0;
  for (int n = 0; n <= 12; ++n) {
    kept += std::pow(pattern_coefficient(pattern, n), 2) / (n == 0 ? 1 : 2);
    if (n < 1) continue;
    // A jump's harmonics fall as 1/n: beyond 4096 they hold less than c_0^2 / 4096.
    const double beyond = pattern.kind == Shape::uniform ? whole / 4096 : 1e-9 * whole;
    EXPECT_NEAR(std::pow(pipelines::truncation_rms(pattern, n), 2), whole - kept, beyond) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(angles, Pattern,
                         testing::Values(PressurePattern{Shape::cosine, 90 * degree},
                                         PressurePattern{Shape::cosine, 30 * degree},
                                         PressurePattern{Shape::cosine, 60 * degree},
                                         PressurePattern{Shape::cosine, 120 * degree},
                                         PressurePattern{Shape::cosine, 170 * degree},
                                         PressurePattern{Shape::cosine, 180 * degree},
                                         PressurePattern{Shape::uniform, 30 * degree},
                                         PressurePattern{Shape::uniform, 90 * degree},
                                         PressurePattern{Shape::uniform, 150 * degree}),
                         name_of);

// coupling.md section 1: p = p0 [1/pi + cos(t)/2 + (2/(3 pi)) cos 2t - (2/(15 pi)) cos 4t + ...].
TEST(PressurePattern, HalfCosineIsTheTextbooks) {
  const PressurePattern half_cosine;
  EXPECT_NEAR(pattern_coefficient(half_cosine, 0), 2 / M_PI, 1e-15);
  EXPECT_NEAR(pattern_coefficient(half_cosine, 2), 4 / (3 * M_PI), 1e-15);
  EXPECT_NEAR(pattern_coefficient(half_cosine, 4), -4 / (15 * M_PI), 1e-15);
  for (const int odd : {3, 5, 7, 63}) EXPECT_EQ(pattern_coefficient(half_cosine, odd), 0) << odd;
  EXPECT_NEAR(pattern_value(half_cosine, 0), 2, 1e-15);
}

// A pressure all round, 1 + cos t, has two harmonics and leaves nothing out.
TEST(PressurePattern, AllRoundHasTwoHarmonics) {
  const PressurePattern all_round{Shape::cosine, M_PI};
  EXPECT_NEAR(pattern_coefficient(all_round, 0), 1, 1e-14);
  for (int n = 2; n < 9; ++n) EXPECT_EQ(pattern_coefficient(all_round, n), 0) << n;
  EXPECT_EQ(pipelines::truncation_bound(all_round, 4), 0);
  EXPECT_EQ(pipelines::truncation_rms(all_round, 4), 0);
}

TEST(PressurePattern, JumpsHaveNoBound) {
  EXPECT_TRUE(std::isinf(pipelines::truncation_bound({Shape::uniform, 1}, 64)));
}

TEST(PressurePattern, RefusesWhatHasNoResultant) {
  EXPECT_THROW(pattern_coefficient({Shape::cosine, 0}, 2), std::invalid_argument);
  EXPECT_THROW(pattern_coefficient({Shape::cosine, 3.2}, 2), std::invalid_argument);
  EXPECT_THROW(pattern_value({Shape::uniform, M_PI}, 0), std::invalid_argument);
  EXPECT_THROW(pattern_coefficient({}, -1), std::invalid_argument);
  EXPECT_THROW(pattern_coefficient({Shape::cosine, std::nan("")}, 2), std::invalid_argument);
}

}  // namespace
