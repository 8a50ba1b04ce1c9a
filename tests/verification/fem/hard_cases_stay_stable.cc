// What breaks finite elements first: hardly compressible material, cells a thousand times longer than thick,
// lengths and loads far from 1. Closed forms, on both solvers where the body is free.
#include <gtest/gtest.h>

#include <cmath>

#include "block_mesh.h"
#include "cylinder_quarter.h"
#include "figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

/// Inner nodes moved against each other; the sides of the unit cube stay.
Point distorted(const Point& c, double amount) {
  const auto bump = [](double t) { return t * (1 - t); };
  return c + 4 * amount *
                 Point(bump(c[0]) * std::sin(5 * c[1] + 3 * c[2]), bump(c[1]) * std::sin(4 * c[2] + 5 * c[0]),
                       bump(c[2]) * std::sin(3 * c[0] + 4 * c[1]));
}

/// w x h x l about the z axis, from z = 0.
fem::Body beam(const Point& size, const std::array<int, 3>& cells, double distortion,
               const fem::Material& material, int degree) {
  verification::Block block;
  block.cells = cells;
  block.map = [size, distortion](const Point& c) {
    const Point d = distorted(c, distortion);
    return Point(size[0] * (d[0] - 0.5), size[1] * (d[1] - 0.5), size[2] * d[2]);
  };
  fem::Body body;
  body.mesh = verification::write_hexahedra(block);
  body.material = material;
  body.degree = degree;
  return body;
}

verification::LoadCase on_ends(double length, Component component, double moment_or_force) {
  return {{verification::on_face(verification::begin_3, {0, 0, 0}, component), -moment_or_force},
          {verification::on_face(verification::end_3, {0, 0, length}, component), moment_or_force}};
}

/// Largest error of any component of stress, of the largest exact one.
template <typename Exact>
double stress_error(const verification::Solution& s, const Exact& exact) {
  double worst = 0, size = 0;
  for (Eigen::Index i = 0; i < s.place_m.cols(); ++i) {
    const Eigen::Matrix<double, 6, 1> theirs = exact(Point(s.place_m.col(i)));
    worst = std::max(worst, (s.stress_Pa.col(i) - theirs).cwiseAbs().maxCoeff());
    size = std::max(size, theirs.cwiseAbs().maxCoeff());
  }
  return worst / size;
}

Eigen::Matrix<double, 6, 1> along_z(double stress) {
  Eigen::Matrix<double, 6, 1> s = Eigen::Matrix<double, 6, 1>::Zero();
  s[2] = stress;
  return s;
}

struct Setting {
  double poisson_ratio;
  int degree;
  fem::Solver solver;
};

class Incompressible : public testing::TestWithParam<Setting> {};

// Saint-Venant's displacements of tension and bending are quadratic: degree 2 and 3 have them exactly on
// straight cells of any shape, so all that is left is rounding times lambda / mu = 5000.
TEST_P(Incompressible, straight_beams_are_exact_on_distorted_cells) {
  const auto [nu, degree, solver] = GetParam();
  const Point size(0.03, 0.04, 0.12);
  const auto body = beam(size, {2, 2, 3}, 0.06, {200e9, nu, 7850}, degree);
  const double area = size[0] * size[1], second = size[0] * std::pow(size[1], 3) / 12;
  const auto pulled =
      verification::solve(body, on_ends(size[2], Component::fz, 1), fem::Recovery::patch, solver);
  EXPECT_LT(stress_error(pulled, [&](const Point&) { return along_z(1 / area); }), 1e-6);
  const auto bent =
      verification::solve(body, on_ends(size[2], Component::mx, 1), fem::Recovery::patch, solver);
  EXPECT_LT(stress_error(bent, [&](const Point& x) { return along_z(x[1] / second); }), 1e-6)
      << bent.solver.reason;
}

// Plane strain locks cells of degree 1 at this ratio. The pressure-like part of the stress is the worst: the
// bounds are those of a mesh of 4 x 4 cells, degree 3 an order better.
TEST_P(Incompressible, thick_cylinder_does_not_lock_on_distorted_cells) {
  const auto [nu, degree, solver] = GetParam();
  if (solver == fem::Solver::iterative) GTEST_SKIP() << "clamped bodies are solved directly";
  constexpr double a = 0.1, b = 0.2, height = 0.05, p_Pa = 50e6;
  verification::Block block;
  block.cells = {4, 4, 1};
  block.map = [&](const Point& c) {
    const Point d(c[0] + 0.1 * c[0] * (1 - c[0]) * std::sin(6 * c[1]),
                  c[1] + 0.1 * c[1] * (1 - c[1]) * std::sin(6 * c[0]), c[2]);
    const double r = a * std::pow(b / a, d[0]), angle = verification::pi / 2 * d[1];
    return Point(r * std::cos(angle), r * std::sin(angle), height * d[2]);
  };
  fem::Body body;
  body.mesh = verification::write_hexahedra(block);
  fem::CylinderChart chart;
  chart.volume_id = verification::block_volume;
  body.cylinders = {chart};
  body.material = {210e9, nu, 7850};
  body.degree = degree;
  body.clamps = {{verification::begin_2, {false, true, false}},
                 {verification::end_2, {true, false, false}},
                 {verification::begin_3, {false, false, true}},
                 {verification::end_3, {false, false, true}}};
  const auto s = verification::solve(
      body, {{verification::uniform_pressure(verification::begin_1, {0, 0, height / 2}, height), p_Pa}});
  const double scale = p_Pa * a * a / (b * b - a * a), e = 210e9;
  const double u_a = (1 + nu) / e * scale * ((1 - 2 * nu) * a + b * b / a);
  EXPECT_NEAR(s.displacement_m(0, s.at({a, 0, 0})), u_a, (degree == 2 ? 2e-3 : 2e-4) * u_a);
  const double error = stress_error(s, [&](const Point& x) {
    const double r2 = x.head<2>().squaredNorm(), cos2 = x[0] * x[0] / r2, sin2 = x[1] * x[1] / r2,
                 sincos = x[0] * x[1] / r2;
    const double radial = scale * (1 - b * b / r2), hoop = scale * (1 + b * b / r2);
    Eigen::Matrix<double, 6, 1> t = along_z(2 * nu * scale);
    t[0] = radial * cos2 + hoop * sin2;
    t[1] = radial * sin2 + hoop * cos2;
    t[3] = (radial - hoop) * sincos;
    return t;
  });
  EXPECT_LT(error, nu > 0.49 ? (degree == 2 ? 0.15 : 0.05) : (degree == 2 ? 0.05 : 0.02));
}

INSTANTIATE_TEST_SUITE_P(
    Settings, Incompressible,
    testing::Values(Setting{0.0, 2, fem::Solver::direct}, Setting{0.0, 3, fem::Solver::iterative},
                    Setting{0.4999, 2, fem::Solver::direct}, Setting{0.4999, 3, fem::Solver::direct},
                    Setting{0.4999, 2, fem::Solver::iterative}, Setting{0.4999, 3, fem::Solver::iterative}),
    [](const auto& info) {
      return std::string(info.param.solver == fem::Solver::direct ? "direct" : "iterative") + "_degree" +
             std::to_string(info.param.degree) + (info.param.poisson_ratio > 0 ? "_nu_4999" : "_nu_0");
    });

class ThinCells : public testing::TestWithParam<double> {};

/// Stiffness across the sheet is aspect^2 that along it; rounding reaches displacements by the condition of
/// bending, and stresses by the differences of these: 1e-16 aspect^2 times a few cells.
double thin_tolerance(double aspect) {
  return std::max(1e-8, 1e-12 * aspect * aspect);
}

// A strip in pure bending about its thin direction; Poisson's ratio 0.3, Saint-Venant again exact.
TEST_P(ThinCells, strip_bends_as_a_beam) {
  const double aspect = GetParam(), cell = 0.05, thickness = cell / aspect;
  const Point size(cell, thickness, 4 * cell);
  const auto body = beam(size, {1, 1, 4}, 0, {206e9, 0.3, 7850}, 2);
  const double second = size[0] * std::pow(thickness, 3) / 12;
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative, fem::Solver::automatic}) {
    const auto s =
        verification::solve(body, on_ends(size[2], Component::mx, 1e-3), fem::Recovery::patch, solver);
    EXPECT_LT(stress_error(s, [&](const Point& x) { return along_z(1e-3 * x[1] / second); }),
              thin_tolerance(aspect))
        << s.solver.reason;
    if (solver == fem::Solver::automatic) {
      EXPECT_EQ(s.solver.used, fem::Solver::direct);
      EXPECT_NE(s.solver.reason.find("stretched"), std::string::npos) << s.solver.reason;
    }
  }
}

// A strip clamped at one end, a force at the other: F l^3 / 3 E I + F l / (5/6 G A), Poisson's ratio 0. The
// cubic deflection is not in the space of 4 cells: a quarter of 1/4^4 of its bending is missing.
TEST_P(ThinCells, cantilever_strip_has_the_deflection_of_a_beam) {
  const double aspect = GetParam(), cell = 0.05, thickness = cell / aspect;
  const Point size(cell, thickness, 4 * cell);
  auto body = beam(size, {1, 1, 4}, 0, {206e9, 0, 7850}, 3);  // degree 3 has the cubic
  body.clamps = {{verification::begin_3, {true, true, true}}};
  const double force = 1e-3, second = size[0] * std::pow(thickness, 3) / 12;
  const double deflection = force * std::pow(size[2], 3) / (3 * 206e9 * second) +
                            force * size[2] / (5.0 / 6 * 103e9 * size[0] * thickness);
  const auto s = verification::solve(
      body, {{verification::on_face(verification::end_3, {0, 0, size[2]}, Component::fy), force}});
  EXPECT_NEAR(s.displacement_m(1, s.at({size[0] / 2, thickness / 2, size[2]})), deflection,
              1e-3 * deflection);
}

// A tube bent as a whole: I = pi/4 (R^4 - r^4); sixteen parabolas for the circle.
TEST_P(ThinCells, tube_bends_as_a_beam) {
  const double aspect = GetParam(), outer = 0.1, length = 0.12;
  const int around = 12;
  const double thickness = 2 * verification::pi * outer / around / aspect, inner = outer - thickness;
  verification::Block block;
  block.cells = {1, around, 3};
  block.is_ring = true;
  block.map = [&](const Point& c) {
    const double r = inner + thickness * c[0], angle = 2 * verification::pi * c[1];
    return Point(r * std::cos(angle), r * std::sin(angle), length * c[2]);
  };
  fem::Body body;
  body.mesh = verification::write_hexahedra(block);
  fem::CylinderChart chart;
  chart.volume_id = verification::block_volume;
  body.cylinders = {chart};
  body.material = {206e9, 0, 7850};
  const double second = verification::pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative}) {
    const auto s = verification::solve(body, on_ends(length, Component::mx, 1), fem::Recovery::patch, solver);
    // Twelve parabolas have a second moment 2e-4 too small; between nodes they leave the circle.
    EXPECT_LT(stress_error(s, [&](const Point& x) { return along_z(x[1] / second); }), 5e-3)
        << s.solver.reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Aspects, ThinCells, testing::Values(17.0, 1000.0),
                         [](const auto& info) { return "aspect_" + std::to_string(int(info.param)); });

// The same bent and pulled beam, a thousand times smaller and larger: stress times length squared (to the
// third) is a number without dimension. 1e-9: what coordinates of another rounding leave.
TEST(Scaling, lengths_of_micrometres_and_kilometres_give_the_same_numbers) {
  const auto answer = [](double unit, Component component, int power, fem::Solver solver) {
    const Point size = unit * Point(0.3, 0.4, 1.2);
    const auto body = beam(size, {2, 2, 4}, 0.04, {206e9, 0.3, 7850}, 2);
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

// Unit loads as large and small as numbers allow to square: bodies of density 1e+-150 under their own
// acceleration, pressures of 1e+-150. A power of two changes no bit, so the answers are compared bit by bit.
TEST(Scaling, loads_are_linear_over_three_hundred_decades) {
  const Point size(0.3, 0.4, 1.2);
  auto body = beam(size, {2, 2, 4}, 0.04, {206e9, 0.3, 7850}, 2);
  const auto loads = [&](double factor) {
    std::vector<fem::UnitLoad> result;
    for (const auto side : {verification::begin_2, verification::end_2}) {
      auto pressure =
          verification::uniform_pressure(side, {0, side == verification::begin_2 ? -0.2 : 0.2, 0.6}, 1.2);
      pressure.coefficient *= factor;
      result.push_back({"pressure." + std::to_string(side), pressure});
    }
    return result;
  };
  body.clamps = {{verification::begin_3, {true, true, true}}};
  const auto solve = [&](const std::vector<fem::UnitLoad>& unit_loads, fem::Solver solver) {
    return fem::Model(body).unit_responses(unit_loads, {}, fem::Recovery::patch, {}, {solver, 1e-10, 100});
  };
  const auto one = solve(loads(1), fem::Solver::direct);
  for (const int exponent : {-498, 498}) {  // 1e-150, 1e150
    const auto other = solve(loads(std::ldexp(1.0, exponent)), fem::Solver::direct);
    EXPECT_EQ(other.residual, one.residual);
    for (std::size_t i = 0; i < one.stress_Pa.size(); ++i)
      ASSERT_EQ(std::ldexp(other.stress_Pa[i], -exponent), one.stress_Pa[i]);
  }
  body.clamps.clear();
  const auto falling = [&](double density) {
    body.material.density_kg_m3 = density;
    return std::vector<fem::UnitLoad>{{"volume.omega2", fem::BodyForce{fem::BodyForce::Field::spin}}};
  };
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative}) {
    const auto usual = solve(falling(1), solver);
    EXPECT_EQ(usual.solver.used, solver) << usual.solver.reason;
    for (const int exponent : {-498, 498}) {
      const auto other = solve(falling(std::ldexp(1.0, exponent)), solver);
      EXPECT_EQ(other.solver.used, solver) << other.solver.reason;
      for (std::size_t i = 0; i < usual.stress_Pa.size(); ++i)
        ASSERT_EQ(std::ldexp(other.stress_Pa[i], -exponent), usual.stress_Pa[i]);
    }
  }
}

// A load vector of nothing but zeros, beside one that is none.
TEST(Scaling, no_load_gives_zero_by_both_solvers) {
  const auto body = beam({0.3, 0.4, 1.2}, {2, 2, 4}, 0.04, {206e9, 0.3, 7850}, 2);
  fem::LoadSurface seat;
  seat.boundary_id = verification::end_2;
  seat.centre_m = {0, 0.2, 0.6};
  seat.radius_m = 1;
  seat.length_m = 1.2;
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative}) {
    auto nothing = verification::uniform_pressure(verification::end_2, {0, 0.2, 0.6}, 1.2);
    nothing.coefficient = 0;
    const auto r = fem::Model(body).unit_responses(
        {{"none.p0", nothing},
         {"pull.fz", verification::on_face(verification::end_3, {0, 0, 1.2}, Component::fz)}},
        {}, fem::Recovery::patch, {}, {solver, 1e-10, 100});
    EXPECT_EQ(r.solver.used, solver) << r.solver.reason;
    EXPECT_TRUE(std::isfinite(r.residual));
    for (std::size_t i = 0; i < r.nodes.n; ++i) {
      for (int c = 0; c < 6; ++c) ASSERT_EQ(r.stress_Pa[2 * 6 * i + c], 0);
      for (int d = 0; d < 3; ++d) ASSERT_EQ(r.displacement_m[2 * 3 * i + d], 0);
      ASSERT_TRUE(std::isfinite(r.stress_Pa[2 * 6 * i + 6 + 2]));
    }
  }
}

}  // namespace
