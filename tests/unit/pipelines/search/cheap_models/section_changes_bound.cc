// What changes from section to section state, of errors whose parts are known.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pipelines/search/cheap_models/section_changes.h"

namespace {

using namespace pipelines;

/// An error of third order that is one on the first section, and one of first order; the truth is so large a
/// drop below them that no share of the value counts.
struct Sequence {
  std::vector<double> values;
  double missing = 0;

  Sequence(int n_sections, double of_first_order) {
    constexpr double truth = 1;
    for (int k = 0; k < n_sections; ++k)
      values.push_back(truth + std::pow(0.125, k) + of_first_order * std::pow(0.5, k));
    missing = std::abs(values.back() - truth);
  }
  double stated_share(Surroundings where) const { return missing_Pa(values, where) / missing; }
};

TEST(SectionChanges, BoundAFilletsErrorWithSomeOfFirstOrder) {
  for (int i = -20; i <= 30; ++i) {
    const double b = 0.01 * i;
    for (int n = 2; n <= 4; ++n)
      EXPECT_GE(Sequence(n, b).stated_share(Surroundings::inside_fillet), 1) << n << ' ' << b;
  }
}

TEST(SectionChanges, BoundBothOrdersElsewhere) {
  for (int n = 2; n <= 4; ++n)
    for (const double b : {-0.2, -0.1, 0.0, 0.1, 0.3, 0.5, 1.0, 1.3, 1.5, 2.0, 10.0, 1000.0})
      EXPECT_GE(Sequence(n, b).stated_share(Surroundings::any), 1) << n << ' ' << b;
}

// Between one and a half and four times what is missing, where places without that knowledge state nine.
TEST(SectionChanges, AreSharpInFillets) {
  for (int n = 2; n <= 4; ++n) {
    const Sequence cubic(n, 0);
    EXPECT_GE(cubic.stated_share(Surroundings::inside_fillet), 1.5) << n;
    EXPECT_LE(cubic.stated_share(Surroundings::inside_fillet), 4) << n;
    EXPECT_GE(cubic.stated_share(Surroundings::any), cubic.stated_share(Surroundings::inside_fillet));
  }
  EXPECT_LE(Sequence(3, 0).stated_share(Surroundings::inside_fillet), 3);
  EXPECT_GT(Sequence(3, 0).stated_share(Surroundings::any), 8);
}

// A fillet that does not show third order is as any place.
TEST(SectionChanges, BelieveFilletsByTheirOrder) {
  const std::vector<double> slow{100, 110, 114};
  EXPECT_EQ(missing_Pa(slow, Surroundings::inside_fillet), missing_Pa(slow, Surroundings::any));
}

// What a fillet of the benchmark's shafts did, whose stress is 18.3598 MPa on sections much finer.
TEST(SectionChanges, BoundAFilletThatStandsStillBesideTheTruth) {
  EXPECT_GE(missing_Pa({18.3580, 18.3610, 18.3613}, Surroundings::inside_fillet), 18.3613 - 18.3598);
}

TEST(SectionChanges, StateSomethingOfValuesThatStandStill) {
  for (const auto where : {Surroundings::any, Surroundings::inside_fillet}) {
    EXPECT_EQ(missing_Pa({7}, where), 7);
    EXPECT_GE(missing_Pa({7, 7}, where), 7 * 0.0015);
    EXPECT_GE(missing_Pa({7, 7, 7}, where), 7 * 3e-5);
  }
}

}  // namespace
