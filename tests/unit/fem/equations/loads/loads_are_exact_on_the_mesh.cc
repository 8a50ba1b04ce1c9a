#include <gtest/gtest.h>

#include <cmath>

#include "fem/equations/loads/surface_loads.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using Phase = fem::SeatPressure::Phase;
constexpr std::array<Component, 6> all = {Component::fx, Component::fy, Component::fz,
                                          Component::mx, Component::my, Component::torque};

struct Loads : testing::Test {
  static void SetUpTestSuite() {
    shaft = new fem_tests::ShaftBody(fem_tests::eccentric_shaft());
    grid = new fem::Grid(fem::make_grid(shaft->body));
  }
  static void TearDownTestSuite() {
    delete grid;
    delete shaft;
  }
  /// Resultants about a surface's centre of a force on its nodes.
  static Eigen::VectorXd about_centre(const fem::LoadedSurface& surface, const Eigen::VectorXd& force) {
    Eigen::MatrixXd all_nodes = Eigen::MatrixXd::Zero(3 * grid->n_nodes, 1);
    for (std::size_t i = 0; i < surface.nodes().size(); ++i)
      all_nodes.block<3, 1>(3 * surface.nodes()[i], 0) = force.segment<3>(3 * i);
    return fem::resultants(*grid, all_nodes, Eigen::Vector3d(surface.surface().centre_m.data()));
  }
  static fem_tests::ShaftBody* shaft;
  static fem::Grid* grid;
};
fem_tests::ShaftBody* Loads::shaft;
fem::Grid* Loads::grid;

TEST_F(Loads, EachResultantHasItsComponent1AndTheOthers0) {
  for (const auto& [name, port] : shaft->ports) {
    const fem::LoadedSurface surface(*grid, port);
    for (int c = 0; c < 6; ++c) {
      const auto sums = about_centre(surface, surface.resultant(all[c]));
      for (int k = 0; k < 6;
           ++k)  // forces of about 1 N per arm of 0.02 m: 1 N m of moment is made of 50 N of force
        EXPECT_NEAR(sums[k], k == c ? 1 : 0, 1e-12 * (c >= 3 ? 50 : 1)) << name << " component " << c;
    }
  }
}

TEST_F(Loads, PressureHarmonicsHaveNoResultant) {
  for (const auto* name : {"bearing_1", "seat", "bearing_2"})
    for (const auto& profile : {std::vector<double>{1}, {0, 1, 0}, {1, 0.25, 0}}) {
      auto port = shaft->ports.at(name);
      port.axial_profile = profile;
      const fem::LoadedSurface surface(*grid, port);
      for (const int n : {0, 2, 3, 4, 5, 8})
        for (const auto phase : {Phase::cosine, Phase::sine}) {
          if (n == 0 && phase == Phase::sine) continue;
          const auto force = surface.pressure({port, n, 1, phase});
          EXPECT_LT(about_centre(surface, force).cwiseAbs().maxCoeff(), 1e-12 * force.lpNorm<1>())
              << name << " " << n;
        }
      for (int c = 0; c < 6; ++c) {
        Eigen::VectorXd expected = Eigen::VectorXd::Unit(6, c);
        const Eigen::VectorXd sums = about_centre(surface, surface.resultant(all[c]));
        EXPECT_LT((sums - expected).cwiseAbs().maxCoeff(), 1e-12 * (c >= 3 ? 50 : 1)) << name << " " << c;
      }
    }
}

// The same traction as on the whole: where the part is the whole body, the same forces.
TEST_F(Loads, OnAPartTheTractionIsThatOfTheWholeSurface) {
  const auto expect_same = [](const Eigen::VectorXd& part, const Eigen::VectorXd& whole) {
    EXPECT_LT((part - whole).lpNorm<Eigen::Infinity>(), 1e-11 * whole.lpNorm<Eigen::Infinity>());
  };
  fem::Grid half = *grid;  // the same nodes, and every other face
  half.boundary.clear();
  for (std::size_t f = 0; f < grid->boundary.size(); f += 2) half.boundary.push_back(grid->boundary[f]);
  fem::Grid rest = half;
  rest.boundary.clear();
  for (std::size_t f = 1; f < grid->boundary.size(); f += 2) rest.boundary.push_back(grid->boundary[f]);
  for (const auto* name : {"bearing_1", "seat", "end_1"}) {
    const auto& port = shaft->ports.at(name);
    const fem::LoadedSurface surface(*grid, port);
    for (const auto component : all)
      expect_same(surface.resultant_on(half, component) + surface.resultant_on(rest, component),
                  surface.on_body(surface.resultant(component)));
    if (port.kind != fem::LoadSurface::Kind::seat) continue;
    for (const bool keeps : {false, true}) {
      const fem::SeatPressure load{port, 2, 0.7, Phase::cosine, keeps};
      expect_same(surface.pressure_on(half, load) + surface.pressure_on(rest, load),
                  surface.on_body(surface.pressure(load)));
    }
  }
}

// A profile that is not applied, or not scaled to the mean 1, shows in the squeeze of the ends.
TEST_F(Loads, TheAxialProfileShapesThePressure) {
  auto port = shaft->ports.at("seat");
  const auto squeeze = [&](const std::vector<double>& profile, double from, double to) {
    port.axial_profile = profile;
    const fem::LoadedSurface surface(*grid, port);
    const auto force = surface.pressure({port, 0, 1, Phase::cosine});
    double sum = 0;
    for (std::size_t i = 0; i < surface.nodes().size(); ++i) {
      const double* x = grid->position(surface.nodes()[i]);
      const double z = x[2] - port.centre_m[2];
      if (z < from || z > to) continue;
      const double dx = x[0] - port.centre_m[0], dy = x[1] - port.centre_m[1];
      sum -= (force[3 * i] * dx + force[3 * i + 1] * dy) / std::hypot(dx, dy);
    }
    return sum;
  };
  const double b = port.length_m, uniform = squeeze({1}, -b, b);
  EXPECT_NEAR(uniform, 2, 2e-2);  // 2 pi R b / (pi R b); the circle has eight sectors
  // Scaled to the mean 1 the total stays; the kink in the middle may lie inside a cell, whose Gauss points
  // miss it.
  EXPECT_NEAR(squeeze({0, 1, 0}, -b, b), uniform, 1e-2 * uniform);
  EXPECT_NEAR(squeeze({1, 3, 5}, -b, b), uniform, 1e-6 * uniform);
  // 1 at one end and 5 at the other: a quarter and three quarters less and more on the outer quarters.
  EXPECT_GT(squeeze({1, 3, 5}, b / 4, b), 1.8 * squeeze({1, 3, 5}, -b, -b / 4));
}

/// Fourier coefficients of max(cos t, 0), in units of that of cos t.
double half_cosine(int n) {
  const double pi = 3.14159265358979323846;
  return n == 0 ? 2 / pi : (n % 4 == 2 ? 4 : -4) / (pi * (double(n) * n - 1));
}

// A mistake in a coefficient or a sign shows: harmonics and resultant together are a half-cosine of resultant
// F, which pushes along F on the loaded side and leaves the other side free.
TEST_F(Loads, HarmonicsAddUpToAHalfCosine) {
  const auto& port = shaft->ports.at("bearing_2");
  const fem::LoadedSurface surface(*grid, port);
  const double beta = 0.7 + 3.14159265358979323846;  // zone centre of a force along 0.7 rad on an outer seat
  Eigen::VectorXd force =
      std::cos(0.7) * surface.resultant(Component::fx) + std::sin(0.7) * surface.resultant(Component::fy);
  double squeeze = 0;
  for (int n = 0; n <= 8; n += 2) {
    const double c = half_cosine(n);
    force += std::cos(n * beta) * surface.pressure({port, n, c, Phase::cosine});
    if (n > 0) force += std::sin(n * beta) * surface.pressure({port, n, c, Phase::sine});
  }
  double on_loaded_side = 0;
  for (std::size_t i = 0; i < surface.nodes().size(); ++i) {
    const double* x = grid->position(surface.nodes()[i]);
    const double theta = std::atan2(x[1], x[0]);
    const double inward = -(force[3 * i] * std::cos(theta) + force[3 * i + 1] * std::sin(theta));
    squeeze += inward;
    if (std::cos(theta - beta) > -1e-9) on_loaded_side += inward;
  }
  // The integral of p = (2/(pi R b)) cos t over |t| < pi/2 is 4/pi for a resultant of 1.
  EXPECT_NEAR(squeeze, 4 / 3.14159265358979323846, 0.01);  // the coarse circle, 8 sectors
  EXPECT_NEAR(on_loaded_side / squeeze, 1.0, 0.02);        // five harmonics of infinitely many
}

TEST_F(Loads, BodyForcesHaveTheResultantsOfTheMass) {
  const auto integrals = fem::integrate_nodes(*grid, fem::colour_cells(*grid, fem::cells_of_nodes(*grid)));
  const auto mass = fem::mass_properties(*grid, integrals, 7850);
  const auto sums = [&](fem::BodyForce::Field field) -> Eigen::VectorXd {
    return fem::resultants(*grid, fem::body_force(integrals, 7850, field), Eigen::Vector3d::Zero());
  };
  const double tolerance = 1e-13 * mass.mass_kg;
  const auto& s = mass.first_moment_kg_m;
  const auto& j = mass.second_moments_kg_m2;
  const auto expect = [&](fem::BodyForce::Field field, const std::array<double, 6>& exact) {
    const auto ours = sums(field);
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(ours[k], exact[k], tolerance) << static_cast<int>(field) << " " << k;
  };
  expect(fem::BodyForce::Field::translation_x, {mass.mass_kg, 0, 0, 0, s[2], -s[1]});
  expect(fem::BodyForce::Field::translation_y, {0, mass.mass_kg, 0, -s[2], 0, s[0]});
  expect(fem::BodyForce::Field::translation_z, {0, 0, mass.mass_kg, s[1], -s[0], 0});
  expect(fem::BodyForce::Field::rotation, {-s[1], s[0], 0, -j[5], -j[4], j[0] + j[1]});
  expect(fem::BodyForce::Field::spin, {s[0], s[1], 0, -j[4], j[5], 0});
}

TEST_F(Loads, BalancedLoadsHaveNoResultants) {
  const auto integrals = fem::integrate_nodes(*grid, fem::colour_cells(*grid, fem::cells_of_nodes(*grid)));
  std::vector<fem::UnitLoad> loads;
  for (const auto& [name, port] : shaft->ports)
    for (const auto c : all) loads.push_back(fem_tests::resultant(*shaft, name, c));
  loads.push_back({"volume.omega2", fem::BodyForce{fem::BodyForce::Field::spin}});
  auto force = fem::load_vectors(*grid, integrals, 7850, loads);
  fem::RigidBalance(*grid, integrals).balance(force);
  const auto rest = fem::resultants(*grid, force, Eigen::Vector3d::Zero());
  for (Eigen::Index k = 0; k < force.cols(); ++k)
    EXPECT_LT(rest.col(k).cwiseAbs().maxCoeff(), 1e-13 * force.col(k).lpNorm<1>()) << loads[k].channel;
}

}  // namespace
