/// Worked examples of Shigley's Mechanical Engineering Design (8th to 10th ed.), within the digits of the
/// print. Turns red: a factor 2 or sqrt(3) lost between moment and stress, S_y taken for S_ut, a wrong
/// exponent.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "pipelines/base/fatigue/endurance.h"
#include "pipelines/base/fatigue/mean_stress.h"

namespace {

using namespace pipelines;
constexpr double psi = 6894.757293168, inch = 0.0254, lbf_in = 4.4482216152605 * inch;

// Example 7-1: d = 1.1 in, M_a = 1260, T_m = 1100 lbf in, K_f = 1.58, K_fs = 1.39 (as printed), S_ut = 105
// kpsi.
CyclicStress stress_of_example_7_1() {
  const double per_torque = 16 / (std::acos(-1) * std::pow(1.1 * inch, 3));
  return {2 * per_torque * 1.58 * 1260 * lbf_in, std::sqrt(3.0) * per_torque * 1.39 * 1100 * lbf_in};
}

TEST(ShigleyExamples, Shoulder7_1) {
  const CyclicStress stress = stress_of_example_7_1();
  EXPECT_NEAR(stress.amplitude_Pa / psi, 15235.25341, 1e-4);  // independent program, ten digits
  EXPECT_NEAR(stress.mean_Pa / psi, 10133.51623, 1e-4);
  const auto n = mean_stress_safety(stress, {29.3e3 * psi, 105e3 * psi, 82e3 * psi});
  EXPECT_NEAR(n.goodman, 1.622101595, 1e-8);  // the print: 1.62, 1.87, 1.88, 1.56, each rounded on the way
  EXPECT_NEAR(n.gerber, 1.861125558, 1e-8);   // likewise to the reference's digits
  EXPECT_NEAR(n.asme_elliptic, 1.871054312, 1e-8);
  EXPECT_NEAR(n.soderberg, 1.553871195, 1e-8);
  // n_y of the reference adds both von Mises stresses in squares (they act on different planes): 4.481.
  EXPECT_NEAR(82e3 * psi / std::hypot(stress.amplitude_Pa, stress.mean_Pa), 4.481469199, 1e-8);
  EXPECT_NEAR(n.yield, 82e3 / (15235.25341 + 10133.51623), 1e-6);  // Langer's sum is the safe side
}

TEST(ShigleyExamples, Table6_5OfReliability) {
  const double table[][2] = {{0.5, 1},       {0.9, 0.897},    {0.95, 0.868},    {0.99, 0.814},
                             {0.999, 0.753}, {0.9999, 0.702}, {0.99999, 0.659}, {0.999999, 0.620}};
  for (const auto& [reliability, k_e] : table)
    EXPECT_NEAR(marin_reliability_factor(reliability), k_e, 0.0006) << reliability;
  EXPECT_NEAR(reliability_factor_of_97_5(0.975), 1, 1e-15);
}

// Scaling the stress by the safety reaches the line exactly; this is what safety means.
TEST(ShigleyExamples, SafetyReachesTheLine) {
  const MeanStressStrength s{200e6, 700e6, 500e6};
  for (const double mean : {0.0, 30e6, 300e6}) {
    const auto n = mean_stress_safety({80e6, mean}, s);
    const double a = 80.0 / 200, t = mean / 700e6, y = mean / 500e6;
    EXPECT_NEAR(n.goodman * (a + t), 1, 1e-14);
    EXPECT_NEAR(n.gerber * a + std::pow(n.gerber * t, 2), 1, 1e-14);
    EXPECT_NEAR(std::pow(n.asme_elliptic * a, 2) + std::pow(n.asme_elliptic * y, 2), 1, 1e-14);
    EXPECT_LE(n.soderberg, n.goodman);
    EXPECT_LE(n.goodman, n.gerber);
  }
  EXPECT_EQ(mean_stress_safety({80e6, -300e6}, s).goodman, 2.5);
  EXPECT_NEAR(mean_stress_safety({80e6, -300e6}, s).yield, 500.0 / 380, 1e-14);
  EXPECT_EQ(mean_stress_safety({0, 0}, s).gerber, std::numeric_limits<double>::infinity());
  EXPECT_THROW(mean_stress_safety({-1, 0}, s), std::invalid_argument);
  EXPECT_THROW(mean_stress_safety({1, 0}, {200e6, 400e6, 500e6}), std::invalid_argument);
  EXPECT_THROW(marin_reliability_factor(0.3), std::invalid_argument);
}

}  // namespace
