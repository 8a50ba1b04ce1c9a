// Lengths and loads far from 1, and no load at all, by both solvers.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/verification/fem/block_mesh.h"
#include "tests/verification/fem/distorted_beam.h"
#include "tests/verification/fem/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

// The same bent and pulled beam, a thousand times smaller and larger: stress times length squared (to the
// third) is a number without dimension. 1e-9: what coordinates of another rounding leave.
TEST(Scaling, LengthsOfMicrometresAndKilometresGiveTheSameNumbers) {
  const auto answer = [](double unit, Component component, int power, fem::Solver solver) {
    const Point size = unit * Point(0.3, 0.4, 1.2);
    const auto body = verification::distorted_beam(size, {2, 2, 4}, 0.04, {206e9, 0.3, 7850}, 2);
    const auto s = verification::solve(
        body, {{verification::on_face(verification::end_3, {0, 0, size[2]}, component), 1}},
        fem::Recovery::patch, solver);
    return std::pair<Eigen::MatrixXd, Eigen::MatrixXd>(s.stress_Pa * std::pow(unit, power),
                                                       s.displacement_m * std::pow(unit, power - 1));
  };
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative})
    for (const auto& [component, power] :
         {std::pair{Component::fx, 2}, {Component::fz, 2}, {Component::torque, 3}}) {
      const auto one = answer(1, component, power, solver);
      for (const double unit : {1e-6, 1e-3, 1e3}) {
        const auto other = answer(unit, component, power, solver);
        EXPECT_LT((other.first - one.first).cwiseAbs().maxCoeff(), 1e-9 * one.first.cwiseAbs().maxCoeff())
            << unit;
        EXPECT_LT((other.second - one.second).cwiseAbs().maxCoeff(), 1e-9 * one.second.cwiseAbs().maxCoeff())
            << unit;
      }
    }
}

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
  body.mesh = verification::write_hexahedra(block);
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

// Unit loads of 1e-150 and 1e150: their squares are no numbers any more. Powers of two change no bit, so the
// answers are compared bit by bit.
TEST(Scaling, LoadsAreLinearOverThreeHundredDecades) {
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
    }
  }
}

// A load vector of nothing but zeros, beside one that is none.
TEST(Scaling, NoLoadGivesZeroByBothSolvers) {
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
  }
}

}  // namespace
