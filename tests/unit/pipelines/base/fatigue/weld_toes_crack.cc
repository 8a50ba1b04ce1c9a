/// IIW curves, thickness, and which stress governs a toe.
/// Turns red: the curve of a thick plate without f(t), amplitude for range, knee at 2e6, f(t) above 1 for
/// thin plates, a sector of 45 or 90 degrees.
#include "pipelines/base/fatigue/weld_fatigue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {

using namespace pipelines;

TEST(WeldFatigue, ClassAndKnee) {
  const SnCurve curve = weld_curve({}, LoadAmplitude::constant);
  EXPECT_NEAR(*cycles_to_failure(curve, 90e6), 2e6, 1e-5);
  EXPECT_NEAR(curve.knee_amplitude_Pa, 52.6e6, 0.1e6);  // IIW table 3.2-2: FAT 90 has its knee at 52.7 MPa
  EXPECT_NEAR(*cycles_to_failure(curve, 26.3e6) / (1e7 * std::pow(curve.knee_amplitude_Pa / 26.3e6, 22)), 1,
              1e-12);
  const SnCurve variable = weld_curve({}, LoadAmplitude::variable);
  EXPECT_NEAR(*cycles_to_failure(variable, variable.knee_amplitude_Pa / 2), 32e7, 1);
  EXPECT_NEAR(weld_damage({}, LoadAmplitude::variable, {{180e6, 0, 1000}}), 1000 * 8 / 2e6, 1e-15);
  WeldDetail detail;
  detail.gamma_M = 1.25;
  EXPECT_NEAR(*cycles_to_failure(weld_curve(detail, LoadAmplitude::variable), 72e6), 2e6, 1e-5);
  detail.fat_Pa = 90;
  EXPECT_THROW(weld_curve(detail, LoadAmplitude::variable), std::invalid_argument);
}

TEST(WeldFatigue, Thickness) {
  EXPECT_EQ(thickness_factor(0.010), 1);
  EXPECT_NEAR(thickness_factor(0.050), std::pow(0.5, 0.3), 1e-15);
  EXPECT_NEAR(thickness_factor(0.050, thickness_exponent::transverse_butt), std::pow(0.5, 0.2), 1e-15);
  EXPECT_THROW(thickness_factor(0), std::invalid_argument);
}

// FAT 90 of a 50 mm plate, n = 0.3, gamma_M 1.35: 90 x 0.5^0.3 / 1.35 = 54.15016 MPa at 2e6 cycles, at 1e7
// 0.2^(1/3) of that, 31.66721 MPa.
TEST(WeldFatigue, TheCurveOfAThickPlateIsLower) {
  for (const auto amplitude : {LoadAmplitude::constant, LoadAmplitude::variable}) {
    const SnCurve curve = weld_curve({90e6, 0.050, 0.3, 1.35}, amplitude);
    EXPECT_NEAR(curve.knee_amplitude_Pa, 31.66721e6, 5);  // digits written above
    EXPECT_NEAR(*cycles_to_failure(curve, 54.15016e6), 2e6, 1);
    EXPECT_NEAR(*cycles_to_failure(curve, 2 * 54.15016e6), 2e6 / 8, 0.2);
    // A factor f on the class is one of f^3 on the life, 0.5^0.9.
    EXPECT_NEAR(*cycles_to_failure(curve, 100e6) /
                    *cycles_to_failure(weld_curve({90e6, 0.025, 0.3, 1.35}, amplitude), 100e6),
                0.5358867, 1e-7);
  }
}

/// Uniaxial stress in the surface z = 0 at an angle to x, one period of a cosine about a mean.
Eigen::Matrix<double, 6, Eigen::Dynamic> at_angle(double degrees) {
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  Eigen::Matrix<double, 6, Eigen::Dynamic> h = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 36);
  for (int i = 0; i < 36; ++i) {
    const double stress = 20 + 50 * std::cos(2 * M_PI * i / 36);
    h(0, i) = c * c * stress;
    h(1, i) = s * s * stress;
    h(3, i) = c * s * stress;
  }
  return h;
}

TEST(WeldFatigue, PrincipalWithin60Degrees) {
  const auto toe = [](double degrees) {
    return toe_stress(at_angle(degrees), Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(3, 0, 1), {});
  };
  for (const double degrees : {-59.0, -20.0, 0.0, 45.0, 59.0}) {
    const ToeStress stress = toe(degrees);
    EXPECT_TRUE(stress.is_principal) << degrees;
    EXPECT_NEAR(stress.angle_rad, degrees * M_PI / 180, 1e-6);  // a maximum is flat: root of rounding
    ASSERT_EQ(stress.cycles.size(), 1u);
    EXPECT_NEAR(stress.cycles[0].range, 100, 1e-10);
    EXPECT_NEAR(stress.cycles[0].mean, 20, 1e-10);
  }
  for (const double degrees : {62.0, 80.0, -75.0}) {
    const ToeStress stress = toe(degrees);
    EXPECT_FALSE(stress.is_principal) << degrees;
    EXPECT_NEAR(stress.cycles[0].range, 100 * std::pow(std::cos(degrees * M_PI / 180), 2), 1e-10);
  }
}

// Pure shear along the toe: the principal stresses at 45 degrees count, the stress across the toe is zero.
TEST(WeldFatigue, ShearCountsByItsPrincipalStress) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> h = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 4);
  h.row(3) << 0, 30, 0, -30;
  const ToeStress stress = toe_stress(h, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), {});
  EXPECT_TRUE(stress.is_principal);
  EXPECT_NEAR(std::abs(stress.angle_rad), M_PI / 4, 1e-6);
  EXPECT_NEAR(stress.cycles.at(0).range, 60, 1e-10);
  EXPECT_THROW(toe_stress(h, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ(), {}), std::invalid_argument);
}

// One large cycle across the toe, forty of 0.6 times its range at 45 degrees: below the knee the fifth powers
// of the ranges do the damage and the large cycle leads, above it the third powers, and the many do.
TEST(WeldFatigue, TheDirectionOfMostDamageGoverns) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> h = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 360);
  for (int i = 0; i < 360; ++i) {
    const double slow = 5e6 * std::cos(2 * M_PI * i / 360), fast = 3e6 * std::cos(40 * 2 * M_PI * i / 360);
    h(0, i) = slow + 0.5 * fast;
    h(1, i) = h(3, i) = 0.5 * fast;
  }
  const WeldDetail detail;
  std::vector<double> angles;
  for (const double factor : {1.0, 30.0}) {
    const auto toe = toe_stress(factor * h, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), detail);
    const double damage = weld_damage(detail, LoadAmplitude::variable, toe.cycles);
    for (int degrees = -60; degrees <= 60; ++degrees) {
      const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
      const Eigen::ArrayXd along =
          factor * (c * c * h.row(0) + s * s * h.row(1) + 2 * s * c * h.row(3)).transpose().array();
      EXPECT_GE(damage * (1 + 1e-9),
                weld_damage(detail, LoadAmplitude::variable, kinetics::rainflow_repeating(along)))
          << factor << ' ' << degrees;
    }
    angles.push_back(toe.angle_rad);
  }
  EXPECT_LT(angles[0], 0.6 * angles[1]);  // 21 and 41 degrees
}

}  // namespace
