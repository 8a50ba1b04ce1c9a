// What the three models of the belt say about its strands, against textbook relations.
#include "kinetics/planetary_effects/belt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/kinetics/planetary/planetary_machines.h"

namespace {

using Eigen::ArrayXd;
using kinetics::PlanetaryConvention;
using kinetics::PlanetaryMill;

kinetics::planetary::Tensions of(const PlanetaryMill& mill, double difference_N) {
  return kinetics::planetary::tensions(kinetics::planetary::make_machine(mill),
                                       ArrayXd::Constant(1, difference_N));
}

kinetics::LoadHistory slow(kinetics::PlanetaryBelt belt, PlanetaryConvention convention) {
  auto mill = machines::printed_planetary();
  mill.speed_rad_s = 1;
  mill.belt = belt;
  mill.convention = convention;
  return compute_loads(mill, machines::effects_without(mill, {}), {1, 72});
}

bool warned(const kinetics::LoadHistory& loads, const std::string& of) {
  for (const auto& warning : loads.warnings)
    if (warning.find(of) != std::string::npos) return true;
  return false;
}

// Set B: sin(beta) = 1/9.
const double wrap = std::acos(-1.0) - 2 * std::asin(1.0 / 9);

}  // namespace

TEST(PlanetaryBelt, Ratio) {
  auto mill = machines::printed_planetary();
  mill.belt = kinetics::RatioBelt{3};
  EXPECT_DOUBLE_EQ(of(mill, 100).T2_N[0], 50);
  EXPECT_DOUBLE_EQ(of(mill, 100).T1_N[0], 150);
  EXPECT_DOUBLE_EQ(of(mill, 100).sum_N[0], 200);
  EXPECT_DOUBLE_EQ(of(mill, -100).T1_N[0], 50);  // strands swap
  EXPECT_DOUBLE_EQ(of(mill, -100).T2_N[0], 150);
  EXPECT_DOUBLE_EQ(of(mill, -100).sum_N[0], 200);
  mill.convention = PlanetaryConvention::as_published;  // the paper's belt pushes
  EXPECT_DOUBLE_EQ(of(mill, -100).T1_N[0], -150);
  EXPECT_DOUBLE_EQ(of(mill, -100).T2_N[0], -50);
  EXPECT_DOUBLE_EQ(of(mill, -100).sum_N[0], -200);
}

TEST(PlanetaryBelt, Eytelwein) {
  auto mill = machines::printed_planetary();
  mill.belt = kinetics::EytelweinBelt{0.3};
  for (const double difference : {100.0, -100.0, 1e-6}) {
    const auto t = of(mill, difference);
    const double tight = std::max(t.T1_N[0], t.T2_N[0]), slack = std::min(t.T1_N[0], t.T2_N[0]);
    EXPECT_NEAR(std::log(tight / slack), 0.3 * wrap, 1e-14);
    EXPECT_NEAR((t.T1_N[0] - t.T2_N[0]) / difference, 1, 1e-14);
    EXPECT_NEAR((t.T1_N[0] + t.T2_N[0]) / t.sum_N[0], 1, 1e-14);
  }
  // The friction that makes the paper's ratio of two: mu theta = ln 2, mu = 0.237 (E14).
  mill.belt = kinetics::EytelweinBelt{std::log(2) / wrap};
  EXPECT_NEAR(std::log(2) / wrap, 0.237, 0.0005);
  EXPECT_NEAR(of(mill, 100).T2_N[0], 100, 1e-11);
  EXPECT_NEAR(of(mill, 100).T1_N[0], 200, 1e-11);
}

TEST(PlanetaryBelt, Pretensioned) {
  auto mill = machines::printed_planetary();
  mill.belt = kinetics::PretensionedBelt{1000, 0.3};
  EXPECT_DOUBLE_EQ(of(mill, 100).T1_N[0], 1050);
  EXPECT_DOUBLE_EQ(of(mill, 100).T2_N[0], 950);
  EXPECT_DOUBLE_EQ(of(mill, 0).sum_N[0], 2000);
  EXPECT_DOUBLE_EQ(of(mill, -2400).T1_N[0], -200);
}

TEST(PlanetaryBelt, WrapIsThatOfTheSmallerPulley) {
  auto mill = machines::printed_planetary();
  EXPECT_NEAR(planetary_geometry(mill).wrap_rad, wrap, 1e-15);
  mill.geometry = kinetics::PlanetaryLengths{0.9, 0.1, 0.2};
  EXPECT_NEAR(planetary_geometry(mill).wrap_rad, wrap, 1e-15);
  EXPECT_LT(planetary_geometry(mill).belt_sine, 0);
}

// At 1 rad/s the weight's moment exceeds the inertia's: T1 - T2 changes its sign.
TEST(PlanetaryBelt, Warnings) {
  using C = PlanetaryConvention;
  EXPECT_TRUE(warned(slow(kinetics::RatioBelt{}, C::consistent), "changes sides"));
  EXPECT_FALSE(warned(slow(kinetics::RatioBelt{}, C::consistent), "cannot push"));
  EXPECT_TRUE(warned(slow(kinetics::RatioBelt{}, C::as_published), "cannot push"));
  EXPECT_TRUE(warned(slow(kinetics::EytelweinBelt{0.3}, C::consistent), "changes sides"));
  // The weight asks for up to 300 N between the strands; exp(0.3 * 2.92) = 2.4.
  EXPECT_TRUE(warned(slow(kinetics::PretensionedBelt{100, 0.3}, C::consistent), "hangs slack"));
  EXPECT_TRUE(warned(slow(kinetics::PretensionedBelt{300, 0.3}, C::consistent), "slips"));
  EXPECT_FALSE(warned(slow(kinetics::PretensionedBelt{300, 0.3}, C::consistent), "slack,"));
  EXPECT_TRUE(slow(kinetics::PretensionedBelt{2000, 0.3}, C::consistent).warnings.empty());
  const auto mill = machines::printed_planetary();
  EXPECT_TRUE(compute_loads(mill, machines::effects_without(mill, {}), {1, 36}).warnings.empty());
}
