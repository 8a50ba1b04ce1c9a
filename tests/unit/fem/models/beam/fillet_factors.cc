// Published fits of the stress concentration of shoulder fillets against the elastic solution: public
// verification cases P08 and P09, and the values of the fits that those cases quote.
#include "fem/models/beam/fillet_factors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

struct Case {
  double D, r;  // over d
  double torsion, bending, tension;
};
constexpr Case elastic[] = {{1.1, 0.05, 1.432942, 1.89369, 2.01310}, {1.2, 0.05, 1.527733, 2.08932, 2.31102},
                            {1.2, 0.10, 1.333653, 1.70551, 1.88236}, {1.5, 0.05, 1.615949, 2.27198, 2.69193},
                            {1.5, 0.10, 1.379884, 1.80024, 2.11426}, {1.5, 0.20, 1.223835, 1.47689, 1.70313},
                            {2.0, 0.05, 1.641986, 2.32778, 2.89307}, {2.0, 0.10, 1.393175, 1.82423, 2.22890}};
// Pilkey's fits as the cases quote them; torsion beyond h/r = 4 by DIN 743.
constexpr Case quoted[] = {{1.1, 0.05, 1.461, 1.814, 1.812}, {1.2, 0.05, 1.560, 1.956, 2.018},
                           {1.2, 0.10, 1.357, 1.666, 1.690}, {1.5, 0.05, 1.577, 2.169, 2.261},
                           {1.5, 0.10, 1.413, 1.743, 1.860}, {1.5, 0.20, 1.235, 1.467, 1.554},
                           {2.0, 0.05, 1.615, 2.270, 2.420}, {2.0, 0.10, 1.403, 1.802, 1.965}};

TEST(FilletFactors, AreThePublishedFits) {
  for (const auto& c : quoted) {
    const auto k = fem::fillet_factors(0.04, 0.04 * c.D, 0.04 * c.r);
    // Half of the last printed digit.
    EXPECT_NEAR(k.torsion, c.torsion, 5.1e-4) << c.D << " " << c.r;
    EXPECT_NEAR(k.bending, c.bending, 5.1e-4) << c.D << " " << c.r;
    EXPECT_NEAR(k.tension, c.tension, 5.1e-4) << c.D << " " << c.r;
  }
}

TEST(FilletFactors, LieWithinTheirStatedErrorOfTheElasticSolution) {
  double tension = 0, bending = 0, torsion = 0;
  for (const auto& c : elastic) {
    const auto k = fem::fillet_factors(1, c.D, c.r);
    tension = std::max(tension, std::abs(k.tension / c.tension - 1));
    bending = std::max(bending, std::abs(k.bending / c.bending - 1));
    torsion = std::max(torsion, std::abs(k.torsion / c.torsion - 1));
  }
  EXPECT_LE(tension, fem::fillet_factor_error.tension);
  EXPECT_LE(bending, fem::fillet_factor_error.bending);
  EXPECT_LE(torsion, fem::fillet_factor_error.torsion);
  // and the statement is no larger than it has to be
  EXPECT_GT(tension, fem::fillet_factor_error.tension - 0.01);
  EXPECT_GT(bending, fem::fillet_factor_error.bending - 0.01);
  EXPECT_GT(torsion, fem::fillet_factor_error.torsion - 0.01);
}

// Beyond the polynomials, at h/r above 20 and below 0.1, DIN 743 goes on.
TEST(FilletFactors, OutsideThePolynomialsAreFiniteAndMonotone) {
  double before = std::numeric_limits<double>::max();
  for (const double r : {0.004, 0.008, 0.01, 0.02, 0.05, 0.1, 0.2}) {
    const auto k = fem::fillet_factors(1, 1.4, r);
    EXPECT_GE(k.bending, 1);
    EXPECT_LT(k.bending, before) << r;
    before = k.bending;
  }
  const auto shallow = fem::fillet_factors(1, 1.01, 0.1);  // h/r = 0.05
  EXPECT_NEAR(shallow.bending, 1 + 1 / std::sqrt(.62 * 20 + 11.6 * .1 * 1.44 + .2 * 8000 / 1.01), 1e-12);
}

TEST(FilletFactors, OfNoStepAreRefused) {
  EXPECT_THROW(fem::fillet_factors(0.04, 0.04, 0.001), std::invalid_argument);
  EXPECT_THROW(fem::fillet_factors(0.04, 0.05, 0), std::invalid_argument);
}

}  // namespace
