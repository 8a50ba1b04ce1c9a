// The technological size factor against numbers by hand and against DIN 743-2.
// Turns red: constants of two rows exchanged, the logarithm by e, a factor below the reference size, no end
// for rolled steel.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "pipelines/base/fatigue/technological_size.h"

using namespace pipelines;

namespace {

SizeOfMaterial least_of(MaterialGroup group, double diameter_mm) {
  return sizes_of(group, 1e-3 * diameter_mm).back();
}

}  // namespace

// Structural steel at 60 mm: (1 - 0.11529 x 0.90309) / (1 - 0.11529 x 0.72700) = 0.895883 / 0.916184 for the
// tensile strength, (1 - 0.23058 x 0.90309) / (1 - 0.23058 x 0.72700) = 0.791766 / 0.832368 for the yield
// strength.
TEST(TechnologicalSize, OfStructuralSteelIsAsByHand) {
  const auto sizes = sizes_of(MaterialGroup::steel, 0.060);
  ASSERT_EQ(sizes.size(), 2u);
  EXPECT_STREQ(sizes[0].name, "structural steel");
  EXPECT_EQ(sizes[0].reference_m, 0.040);
  EXPECT_NEAR(sizes[0].tensile_factor, 0.977841, 1e-6);
  EXPECT_NEAR(sizes[0].yield_factor, 0.951220, 1e-6);
  EXPECT_EQ(sizes_of(MaterialGroup::steel, 0.040)[0].tensile_factor, 1);
  EXPECT_EQ(sizes_of(MaterialGroup::steel, 0.040)[0].yield_factor, 1);
}

// DIN 743-2 has K_1 = 1 - 0.26 lg(d / 16 mm) for the tensile strength and 1 - 0.34 lg(d / 16 mm) for the
// yield strength of quenched and tempered steel. The two guidelines fitted the same strengths of the
// standards: to two per cent.
TEST(TechnologicalSize, OfQuenchedAndTemperedSteelIsThatOfDin743) {
  for (const double d_mm : {16.0, 25.0, 40.0, 63.0, 100.0, 160.0, 250.0}) {
    const auto fkm = least_of(MaterialGroup::steel, d_mm);
    const double lg = std::log10(d_mm / 16);
    EXPECT_NEAR(fkm.tensile_factor, 1 - 0.26 * lg, 0.02) << d_mm;
    EXPECT_NEAR(fkm.yield_factor, 1 - 0.34 * lg, 0.02) << d_mm;
  }
  EXPECT_EQ(least_of(MaterialGroup::steel, 400).tensile_factor,
            least_of(MaterialGroup::steel, 250).tensile_factor);
}

// K_d of a casting is that of its thickness: 1.207 below 7.5 mm, 1 at the sample of 20 mm.
TEST(TechnologicalSize, OfGreyIronIsOneAtItsSample) {
  EXPECT_NEAR(least_of(MaterialGroup::grey_cast_iron, 20).tensile_factor, 1, 5e-4)
      << "three digits are printed";
  EXPECT_NEAR(least_of(MaterialGroup::grey_cast_iron, 5).tensile_factor, 1.207, 1e-12);
}

TEST(TechnologicalSize, FallsWithTheDiameter) {
  for (const auto& group : material_groups()) {
    double before = 2;
    for (const double d_mm : {1.0, 7.5, 12.0, 20.0, 60.0, 120.0, 300.0, 1000.0}) {
      for (const auto& size : sizes_of(group.group, 1e-3 * d_mm)) {
        EXPECT_GT(size.tensile_factor, 0.4) << group.name << ' ' << d_mm;
        EXPECT_GE(sizes_of(group.group, 1e-3 * d_mm).front().tensile_factor, size.tensile_factor);
      }
      if (sizes_of(group.group, 1).empty()) continue;
      EXPECT_LE(least_of(group.group, d_mm).tensile_factor, before) << group.name << ' ' << d_mm;
      before = least_of(group.group, d_mm).tensile_factor;
    }
  }
  EXPECT_TRUE(sizes_of(MaterialGroup::wrought_aluminium, 0.1).empty()) << "by its alloy";
  EXPECT_THROW(sizes_of(MaterialGroup::steel, 0), std::invalid_argument);
}
