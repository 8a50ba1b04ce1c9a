/// What charts call the figures and keys of a sweep.
#include <gtest/gtest.h>

#include "pipelines/study/variations/figure_words.h"

using namespace pipelines;

TEST(FigureWords, SayWhatIsDrawn) {
  EXPECT_EQ(figure_in_words("loads.R_A.max"), "R_A, largest");
  EXPECT_EQ(figure_in_words("loads.middle.fy.first"), "middle.fy, at the first instant");
  EXPECT_EQ(figure_in_words("bodies.shaft.governing"), "shaft: governing stress");
  EXPECT_EQ(figure_in_words("bodies.shaft.torsion.max_shear_stress"), "shaft: torsion, max shear stress");
  EXPECT_EQ(figure_in_words("loads.warnings"), "loads.warnings");
  EXPECT_EQ(key_in_words("machine.carrier.initial_angle"), "carrier initial angle");
  EXPECT_EQ(key_in_words("shaft.method"), "shaft method");
}
