// The same body in millimetres and kilometres, the same mill a thousand times smaller and larger: numbers
// without dimension must not change. Reference: the answer at the usual size.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kinetics/vibratory_mill.h"
#include "tests/hard/hard_case.h"
#include "tests/unit/kinetics/planetary/planetary_machines.h"
#include "tests/unit/kinetics/vibratory/machines.h"
#include "tests/verification/fem/bodies/distorted_beam.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

/// A quadratic polynomial through the values of one at 27 points of a cell of size `unit`, by the
/// pseudo-inverse of the normal equations in metres; its value inside.
double naive_recovery(double unit) {
  Eigen::MatrixXd terms(27, 10);
  Eigen::VectorXd values(27);
  const auto row = [](const Point& x) {
    Eigen::Matrix<double, 1, 10> t;
    t << 1, x[0], x[1], x[2], x[0] * x[0], x[1] * x[1], x[2] * x[2], x[0] * x[1], x[1] * x[2], x[2] * x[0];
    return t;
  };
  const auto place = [&](double i, double j, double k) {
    return Point(unit * Point(1 + 0.1 * i, 2 + 0.1 * j, 3 + 0.1 * k));
  };
  const auto stress = [&](const Point& x) { return 1 + x[0] * x[1] / (unit * unit) + x[2] / unit; };
  for (int i = 0; i < 27; ++i) {
    const Point x = place(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    terms.row(i) = row(x);
    values[i] = stress(x);
  }
  const Eigen::VectorXd fit =
      (terms.transpose() * terms).completeOrthogonalDecomposition().solve(terms.transpose() * values);
  const Point middle = place(0.3, 0.2, -0.4);
  return row(middle).dot(fit) / stress(middle);
}

double off(const Eigen::MatrixXd& ours, const Eigen::MatrixXd& wanted) {
  return (ours - wanted).cwiseAbs().maxCoeff() / wanted.cwiseAbs().maxCoeff();
}

}  // namespace

// The same bent and pulled beam, a thousand times smaller and larger: stress times length squared (to the
// third) is a number without dimension. 1e-9: what coordinates of another rounding leave.
TEST(HardScales, LengthsOfMicrometresAndKilometresGiveTheSameNumbers) {
  const auto answer = [](double unit, Component component, int power, fem::Solver solver) {
    const Point size = unit * Point(0.3, 0.4, 1.2);
    const auto body = verification::distorted_beam(size, {2, 2, 4}, 0.04, {206e9, 0.3, 7850}, 2);
    const auto s = verification::solve(
        body, {{verification::on_face(verification::end_3, {0, 0, size[2]}, component), 1}},
        fem::Recovery::patch, solver);
    return std::pair<Eigen::MatrixXd, Eigen::MatrixXd>(s.stress_Pa * std::pow(unit, power),
                                                       s.displacement_m * std::pow(unit, power - 1));
  };
  double worst = 0;
  for (const auto solver : {fem::Solver::direct, fem::Solver::iterative})
    for (const auto& [component, power] :
         {std::pair{Component::fx, 2}, {Component::fz, 2}, {Component::torque, 3}}) {
      const auto one = answer(1, component, power, solver);
      for (const double unit : {1e-6, 1e-3, 1e3}) {
        const auto other = answer(unit, component, power, solver);
        worst = std::max({worst, off(other.first, one.first), off(other.second, one.second)});
      }
    }
  double naive = 0;
  for (const double unit : {1e-6, 1e-3, 1e3}) {
    const double error = hard_cases::relative(naive_recovery(unit), 1);
    if (!(error <= naive)) naive = error;
  }
  hard_cases::check({"units and scales", "stress and displacement of bodies from 1e-6 to 1e3 m",
                     "powers of coordinates in metres", "stress recovered by polynomials in metres", naive,
                     worst, 1e-9});
}

/// Froude's scaling: lengths by s, times by sqrt(s), masses by s^3; forces go with s^3, gravity stays.
TEST(HardScales, MillsOfMillimetresAndKilometres) {
  const auto largest_reaction = [](double s) {
    auto mill = machines::laboratory();
    const double root = std::sqrt(s), cube = s * s * s;
    for (double* length : {&mill.eccentricity_m, &mill.charge_offset_m, &mill.debalance_offset_m})
      *length *= s;
    for (double* mass :
         {&mill.charge_mass_kg, &mill.structure_mass_kg, &mill.exciter_mass_kg, &mill.debalance_mass_kg})
      *mass *= cube;
    mill.chamber_centre_m *= s, mill.structure_centre_m *= s;
    mill.speed_rad_s /= root, mill.charge_relative_speed_rad_s /= root;
    mill.pitch_inertia_kg_m2 *= cube * s * s;
    for (auto& spring : mill.springs)
      spring.position_m *= s, spring.stiffness_N_m *= s * s, spring.damping_N_s_m *= s * s * root;
    const auto loads = compute_loads(mill, machines::effects_without(mill, {"charge_lag"}), {20, 36});
    return Eigen::ArrayXd(loads.quantity("R_E").values / cube);
  };
  const Eigen::ArrayXd usual = largest_reaction(1);
  double ours = 0;
  for (const double s : {1e-3, 1e3})
    ours = std::max(ours, (largest_reaction(s) / usual - 1).abs().maxCoeff());
  // Some hundred roundings.
  hard_cases::check({"units and scales", "a vibratory mill of millimetres and of kilometres",
                     "masses differ by 1e18, the springs' moments cancel", "", std::nullopt, ours, 1e-12});
}

TEST(HardScales, PlanetaryMillsOfMillimetresAndKilometres) {
  const auto largest_load = [](double s) {
    auto mill = machines::printed_planetary();
    mill.speed_rad_s /= std::sqrt(s);
    mill.drum_radius_m *= s, mill.drum_length_m *= s;
    mill.drum_mass_kg *= s * s * s;  // the charge's density stays
    const auto loads = compute_loads(mill, machines::effects_without(mill, {}), {1, 36});
    return Eigen::ArrayXd(loads.quantity("R_A").values / (s * s * s));
  };
  const Eigen::ArrayXd usual = largest_load(1);
  double ours = 0;
  for (const double s : {1e-3, 1e3}) ours = std::max(ours, (largest_load(s) / usual - 1).abs().maxCoeff());
  hard_cases::check({"units and scales", "a planetary mill of millimetres and of kilometres",
                     "masses differ by 1e18", "", std::nullopt, ours, 1e-12});
}
