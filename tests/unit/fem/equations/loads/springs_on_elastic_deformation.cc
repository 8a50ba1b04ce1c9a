#include <gtest/gtest.h>

#include <cmath>

#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;

/// A rod pulled at both ends by 1 N, each end held by a spring against its elastic displacement.
double elongation_m(const std::array<double, 3>& stiffness_N_m) {
  auto rod = fem_tests::rod(8);
  rod.body.material.poisson_ratio = 0;  // uniform tension is then the exact solution
  for (const auto* end : {"end_1", "end_2"})
    rod.body.elastic_supports.push_back({rod.ports.at(end), stiffness_N_m});
  const auto responses = fem::Model(rod.body).unit_responses(
      {fem_tests::resultant(rod, "end_1", Component::fz), fem_tests::resultant(rod, "end_2", Component::fz)},
      {});
  double first = 0, last = 0;
  for (std::size_t i = 0; i < responses.nodes.n; ++i) {
    const double u = responses.displacement_m[(2 * i + 1) * 3 + 2] - responses.displacement_m[2 * i * 3 + 2];
    const double x = responses.nodes.xyz_m[3 * i], y = responses.nodes.xyz_m[3 * i + 1],
                 z = responses.nodes.xyz_m[3 * i + 2];
    if (std::hypot(x, y) > 1e-9) continue;
    if (std::abs(z) < 1e-12) first = u;
    if (std::abs(z - 0.2) < 1e-12) last = u;
  }
  return last - first;
}

// The exact rod: EA/L of the meshed cross-section, each end's displacement half of the elongation, so that
// F = (EA/L + k/2) elongation. A spring that is left out, taken twice, or held against a rigid motion shows.
TEST(ElasticSupports, ShareTheLoadWithTheRod) {
  const double free_m = elongation_m({0, 0, 0}), rod_N_m = 1 / free_m;
  EXPECT_NEAR(rod_N_m, fem_tests::steel.youngs_modulus_Pa * M_PI * 0.025 * 0.025 / 0.2, 1e-3 * rod_N_m);
  for (const double k : {1.0, 1e6, 1e9, 1e12})
    EXPECT_NEAR(elongation_m({0, 0, k}), 1 / (rod_N_m + k / 2), 1e-8 / (rod_N_m + k / 2)) << k;
  // Across the rod nothing moves; 1e-8: the solver's residual times its ten.
  EXPECT_NEAR(elongation_m({1e9, 1e9, 0}), free_m, 1e-8 * free_m);
}

TEST(ElasticSupports, NegativeStiffnessIsRefused) {
  EXPECT_THROW(elongation_m({0, -1, 0}), std::invalid_argument);
}

}  // namespace
