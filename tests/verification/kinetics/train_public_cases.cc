// Torsion trains of the public verification set: P17, P18, P26; closed forms in it, tolerances of its own
// digits.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/kinetics/torsion/trains.h"

namespace {

const double pi = std::acos(-1.0);

}  // namespace

// Thomson & Dahleh, Holzer example.
TEST(TrainPublicCases, P17_three_discs) {
  const auto modes = natural_modes(trains::chain({5, 11, 22}, {1e5, 2e5}));
  EXPECT_NEAR(modes.frequency_rad_s[1] / 123.6658001, 1, 1e-9);
  EXPECT_NEAR(modes.frequency_rad_s[2] / 202.6583486, 1, 1e-9);
  const auto shape = modes.reduced_shape.col(1) / modes.reduced_shape(0, 1);
  EXPECT_NEAR(shape[1], 0.2353384945, 1e-9);
  EXPECT_NEAR(shape[2], -0.3449419745, 1e-9);
}

// Friswell et al., two rotors driven by a motor through a reversing rigid gear; a tree with a branch.
TEST(TrainPublicCases, P18_geared_motor) {
  kinetics::DriveTrain train = trains::chain({400e-6, 25e-6, 25e-6, 700e-6, 700e-6}, {1e4, 1, 5e3, 5e3});
  train.inertias[2].shaft = train.inertias[3].shaft = "t";
  auto& gear = train.elements[1];
  gear.kind = kinetics::ElementKind::gear;
  gear.rigid = true;
  gear.ratio = -1;
  gear.stiffness_N_m_rad.reset();
  train.elements[3].first = "J1";
  const auto modes = natural_modes(train);
  ASSERT_EQ(modes.frequency_rad_s.size(), 4);
  const double wanted_Hz[] = {425.3594775, 634.07276, 3247.192354};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(modes.frequency_rad_s[k + 1] / (2 * pi) / wanted_Hz[k], 1, 1e-9);
  EXPECT_NEAR((modes.shape.row(2) + modes.shape.row(1)).abs().maxCoeff(), 0, 1e-15);
}

// Drill string: a continuous shaft in n lumps, half a lump at the ends; second order in 1/n. (The set's
// values for consistent-mass elements need a matrix of inertias, which a train of lumps has not.)
TEST(TrainPublicCases, P26_drill_string_converges_to_the_continuum) {
  const double I_p = pi / 32 * (std::pow(0.78, 4) - std::pow(0.65, 4)), length_m = 800;
  const auto frequencies_Hz = [&](int n) {
    std::vector<double> J(n + 1, 8000 * I_p * length_m / n), C(n, 75e9 * I_p / (length_m / n));
    J.front() = J.front() / 2 + 200;
    J.back() = J.back() / 2 + 10;
    return Eigen::ArrayXd(
        natural_modes(trains::chain(J, C), kinetics::Shapes::none).frequency_rad_s.segment(1, 4) / (2 * pi));
  };
  const Eigen::Array4d exact(1.910332294, 3.820664759, 5.730997568, 7.641330893);
  const Eigen::Array4d coarse = (frequencies_Hz(100) - exact).abs(),
                       fine = (frequencies_Hz(200) - exact).abs();
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(std::log2(coarse[k] / fine[k]), 2, 0.02) << k;
    EXPECT_LT(fine[k] / exact[k], 2e-4);
  }
  EXPECT_NEAR(frequencies_Hz(800)[0] / exact[0], 1, 1e-5);
}
