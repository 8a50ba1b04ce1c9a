// Loads whose squares are no numbers, and no load at all, by both solvers. Powers of two change no bit, so
// that answers are compared bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipelines/superpose/envelope/superposition.h"
#include "tests/hard/hard_case.h"
#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using verification::Point;

/// A whole tube of radii 0.2 and 0.3 m.
fem::Body tube(double density_kg_m3) {
  verification::Block block;
  block.cells = {2, 8, 2};
  block.is_ring = true;
  block.map = [](const Point& c) {
    const double r = 0.2 + 0.1 * c[0], angle = 2 * verification::pi * c[1];
    return Point(r * std::cos(angle), r * std::sin(angle), 0.2 * c[2]);
  };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  fem::CylinderChart chart;
  chart.volume_id = verification::block_volume;
  body.cylinders = {chart};
  body.material = {206e9, 0.3, density_kg_m3};
  return body;
}

/// Pressure inside, and the field of spin, both times a factor.
fem::UnitResponses pressed_and_spun(double factor, fem::Solver solver) {
  auto pressure = verification::uniform_pressure(verification::begin_1, {0, 0, 0.1}, 0.2);
  pressure.coefficient *= factor;
  return fem::Model(tube(factor))
      .unit_responses(
          {{"inside.p0", pressure}, {"volume.omega2", fem::BodyForce{fem::BodyForce::Field::spin}}}, {},
          fem::Recovery::patch, {}, {solver, 1e-10, 100});
}

/// |f| of a vector of ones times a factor, by the sum of squares.
double naive_norm(double factor) {
  double sum = 0;
  for (int i = 0; i < 9; ++i) sum += factor * factor;
  return std::sqrt(sum);
}

// Unit loads of 1e-150 and 1e150, and farther.
TEST(HardLoads, LoadsAreLinearOverThreeHundredDecades) {
  double ours = 0, naive = 0;
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative}) {
    const auto usual = pressed_and_spun(1, solver);
    EXPECT_EQ(usual.solver.used, solver) << usual.solver.reason;
    for (const int exponent : {-498, 498, -664, 664}) {  // 1e-150, 1e150, 1e-200, 1e200
      const auto other = pressed_and_spun(std::ldexp(1.0, exponent), solver);
      EXPECT_EQ(other.solver.used, solver) << other.solver.reason;
      for (std::size_t i = 0; i < usual.stress_Pa.size(); ++i)
        ASSERT_EQ(std::ldexp(other.stress_Pa[i], -exponent), usual.stress_Pa[i]) << exponent;
      EXPECT_EQ(other.energy_error.error, usual.energy_error.error) << exponent;
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_EQ(std::ldexp(other.energy_error.norm_sqrtJ[k], -exponent), usual.energy_error.norm_sqrtJ[k]);
      for (std::size_t i = 0; i < usual.displacement_m.size(); ++i)
        if (usual.displacement_m[i] != 0)
          ours = std::max(ours, hard_cases::relative(std::ldexp(other.displacement_m[i], -exponent),
                                                     usual.displacement_m[i]));
      naive = std::max(naive,
                       hard_cases::relative(std::ldexp(naive_norm(std::ldexp(1.0, exponent)), -exponent), 3));
    }
  }
  hard_cases::check({"loads", "unit loads of 1e-200, 1e-150, 1e150 and 1e200, both solvers",
                     "the norms of residuals and energies are squares", "|f| by the sum of squares", naive,
                     ours, 0});
}

// A load vector of nothing but zeros, beside one that is none.
TEST(HardLoads, NoLoadGivesZeroByBothSolvers) {
  double ours = 0;
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative}) {
    auto nothing = verification::uniform_pressure(verification::begin_1, {0, 0, 0.1}, 0.2);
    nothing.coefficient = 0;
    const auto r = fem::Model(tube(7850))
                       .unit_responses({{"none.p0", nothing},
                                        {"volume.omega2", fem::BodyForce{fem::BodyForce::Field::spin}}},
                                       {}, fem::Recovery::patch, {}, {solver, 1e-10, 100});
    EXPECT_EQ(r.solver.used, solver) << r.solver.reason;
    EXPECT_TRUE(std::isfinite(r.residual));
    EXPECT_EQ(r.energy_error.norm_sqrtJ[0], 0);
    EXPECT_EQ(r.energy_error.error[0], 0);
    EXPECT_GT(r.energy_error.error[3], 0);
    for (std::size_t i = 0; i < r.nodes.n; ++i) {
      for (std::size_t c = 0; c < 6; ++c) ASSERT_EQ(r.stress_Pa[12 * i + c], 0);
      for (std::size_t d = 0; d < 3; ++d) ASSERT_EQ(r.displacement_m[6 * i + d], 0);
      ASSERT_TRUE(std::isfinite(r.stress_Pa[12 * i + 6]));
    }
    ours = std::isfinite(r.residual) ? std::max(ours, r.energy_error.error[0]) : r.residual;
  }
  const double residual = naive_norm(0) / naive_norm(0);
  hard_cases::check({"loads", "no load, both solvers", "its residual has nothing to be compared with",
                     "|K u - f| / |f|", residual, ours, 0});
}

// Shear of sizes beyond the squares of doubles: sqrt(3) times itself. A square root and a product: 4e-16.
TEST(HardLoads, MeasuresOfStressOfAnySize) {
  double ours = 0, naive = 0;
  for (const double s : {1e-300, 1e-200, 1e200, 1e300}) {
    const long double wanted = std::sqrt(3.0L) * s;
    ours = std::max(ours, hard_cases::relative(pipelines::von_mises_Pa({0, 0, 0, s, 0, 0}), wanted));
    naive = std::max(naive, hard_cases::relative(std::sqrt(3 * s * s), wanted));
  }
  hard_cases::check({"loads", "von Mises stress of 1e-300 to 1e300 Pa", "it is a root of squares",
                     "its formula", naive, ours, 1e-15});
}

}  // namespace
