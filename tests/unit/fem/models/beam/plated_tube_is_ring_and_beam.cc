// The thin tube with plates against the two closed forms that it must have: a beam between its ends, a ring
// under a load that does not vary along it.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "fem/base/values/constants.h"
#include "fem/models/beam/plated_tube.h"

namespace {

using fem::pi;
using fem::PlateLoad;
constexpr fem::Material tube_steel{206e9, 0.3, 7850};

fem::PlatedTube tube(double length_m, double wall_m, const std::vector<fem::TubePlate>& plates) {
  return {0.1 + wall_m / 2, wall_m, -length_m / 2, length_m / 2, tube_steel, plates};  // middle radius 0.1
}

/// Of plate p and load in the stress at the i-th point.
const std::array<double, 6>& at(const std::vector<std::array<double, 6>>& stress, std::size_t i,
                                std::size_t n_plates, std::size_t p, PlateLoad load) {
  return stress[(i * n_plates + p) * fem::n_plate_loads + std::size_t(load)];
}

}  // namespace

// Far from the plate a tube bends like a beam on two supports that a force at mid-span pushes sideways: M = F
// s / 2, sigma_z = M R cos / (pi r^3 t). What is not round dies away: 2 m are twelve decay lengths 1/mu of
// the slowest wave, mu^2 = t n^2 (n^2 - 1) / (2 sqrt(12 (1 - nu^2)) r^3), n = 2.
TEST(PlatedTube, BendsLikeABeam) {
  const double wall = 0.02, length = 6, s = 1.0;  // s from the left end
  const auto stress = fem::plated_tube_stress_Pa(tube(length, wall, {{0.4, 0.6, 0, 0.05}}),
                                                 {{0, s - length / 2}, {pi / 2, s - length / 2}, {0.4, 0}});
  const double at_rim = 0.5 * s * 0.11 / (pi * 1e-3 * wall);
  // The shell's bending is that of a plate, held across: nu^2 = 9 % more for a tenth of the stress.
  EXPECT_NEAR(at(stress, 0, 1, 0, PlateLoad::fx)[2], at_rim, 0.015 * at_rim);
  EXPECT_NEAR(at(stress, 1, 1, 0, PlateLoad::fy)[2], at_rim, 0.015 * at_rim);
  EXPECT_NEAR(at(stress, 0, 1, 0, PlateLoad::fy)[2], 0, 1e-3 * at_rim);
  // A torque leaves nothing but shear far off: radial and tangential tractions have no resultant together.
  const double beside = std::abs(at(stress, 2, 1, 0, PlateLoad::torque)[2]) + at_rim;
  for (const std::size_t i : {0, 1}) {
    EXPECT_NEAR(at(stress, i, 1, 0, PlateLoad::torque)[2], 0, 1e-4 * beside / 0.1);
  }
}

// Two opposite forces W per length along the whole tube pull a ring apart. Its free quarters, from the
// plates' edges to half-way between them (an angle b), keep their ends' direction, so that their moment is
// zero on average: half-way
//   M = -W r / 2 (1 - sin(b) / b),
// -(1/2 - 1/pi) W r for plates of no width (Roark's Formulas, 7th ed., table 9.2, case 1), beside the mean
// hoop tension W / (pi t).
TEST(PlatedTube, OpensLikeARing) {
  const double wall = 0.002, length = 8, loaded = 7.9, r = 0.1, line = 1 / loaded;
  // Hoop force of the higher waves, which Morley's equation leaves out: t / (6 r) = 0.3 %. Narrow plates
  // count as points: 0.3 %. Wide ones end half a piece further in, by about a wall of 100 mm: 2 % of b, 4 %
  // of the moment.
  for (const auto& [half_angle, tolerance] : {std::pair{0.02, 0.006}, std::pair{0.5, 0.05}}) {
    const auto stress = fem::plated_tube_stress_Pa(
        tube(length, wall, {{0, half_angle, 0, loaded}, {pi, half_angle, 0, loaded}}),
        {{pi / 2, 0}, {-pi / 2, 0}});
    const double b = half_angle > 0.1 ? pi / 2 - half_angle : pi / 2;
    const double moment = -line * r / 2 * (1 - std::sin(b) / b);
    const double expected = 6 * moment / (wall * wall) + line / (pi * wall);
    for (const std::size_t i : {0, 1}) {
      const double pulled = at(stress, i, 2, 0, PlateLoad::fx)[0] - at(stress, i, 2, 1, PlateLoad::fx)[0];
      EXPECT_NEAR(pulled, expected, tolerance * std::abs(expected)) << half_angle;
    }
  }
}

// A thicker tube turned about its axis has the same stress in turned axes.
TEST(PlatedTube, HasNoPreferredDirection) {
  const double turn = 0.7, wall = 0.006;
  const auto here = fem::plated_tube_stress_Pa(tube(0.26, wall, {{0.2, 0.5, 0.04, 0.014}}), {{0.75, 0.04}});
  const auto there =
      fem::plated_tube_stress_Pa(tube(0.26, wall, {{0.2 + turn, 0.5, 0.04, 0.014}}), {{0.75 + turn, 0.04}});
  const auto hoop = [](const std::array<double, 6>& s) { return s[0] + s[1]; };
  const double c = std::cos(turn), s = std::sin(turn);
  const double scale = std::abs(hoop(here[0])) + std::abs(hoop(here[1]));
  for (const auto measure : {+[](const std::array<double, 6>& t) { return t[0] + t[1]; },
                             +[](const std::array<double, 6>& t) { return t[2]; }}) {
    EXPECT_NEAR(measure(here[0]), c * measure(there[0]) + s * measure(there[1]), 1e-9 * scale);  // rounding
    EXPECT_NEAR(measure(here[1]), -s * measure(there[0]) + c * measure(there[1]), 1e-9 * scale);
    EXPECT_NEAR(measure(here[2]), measure(there[2]), 1e-9 * std::abs(hoop(here[2])));
  }
}

TEST(PlatedTube, ImpossibleSizesAreRefused) {
  EXPECT_THROW(fem::plated_tube_stress_Pa(tube(1, 0.05, {}), {}), std::invalid_argument);  // no thin tube
  EXPECT_THROW(fem::plated_tube_stress_Pa(tube(-1, 0.005, {}), {}), std::invalid_argument);
  EXPECT_THROW(fem::plated_tube_stress_Pa(tube(1, 0.005, {{0, 0.5, 0.6, 0.01}}), {}), std::invalid_argument);
  EXPECT_THROW(fem::plated_tube_stress_Pa(tube(1, 0.005, {{0, 0, 0, 0.01}}), {}), std::invalid_argument);
}
