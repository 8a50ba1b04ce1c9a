// Machines where their formulas divide by nothing, or subtract equals. References: power series and bisection
// in long double, closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinetics/planetary_effects/segment.h"
#include "kinetics/planetary_mill.h"
#include "kinetics/vibratory_effects/motion.h"
#include "kinetics/vibratory_mill.h"
#include "tests/hard/hard_case.h"
#include "tests/unit/kinetics/planetary/planetary_machines.h"
#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using kinetics::planetary::Segment;

const long double pi_l = std::acos(-1.0L);

/// x - sin x by its series, for x below 1.
long double long_x_minus_sin(long double x) {
  long double term = x * x * x / 6, sum = 0;
  for (int k = 2; k < 30; ++k) {
    sum += term;
    term *= -x * x / ((2 * k) * (2 * k + 1.0L));
  }
  return sum;
}

/// Bisection of a function that rises through zero.
template <class Real, class Function>
Real root(Real low, Real high, const Function& rising) {
  for (int i = 0; i < 2000 && low < high; ++i) {
    const Real middle = low > 0 ? std::sqrt(low) * std::sqrt(high) : (low + high) / 2;
    if (middle <= low || middle >= high) break;
    (rising(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Half angle of a segment with this share of the circle, by bisection of gamma - sin(gamma) cos(gamma).
double naive_half_angle(double share) {
  return root(1e-12, machines::pi,
              [&](double gamma) { return gamma - std::sin(gamma) * std::cos(gamma) - machines::pi * share; });
}

long double half_angle_of_small_share(long double share) {
  return root(1e-300L, 1.0L, [&](long double x) { return long_x_minus_sin(x) - 2 * pi_l * share; }) / 2;
}

/// The centroid's distance, (12) of the paper.
double naive_centroid(double gamma) {
  return 4.0 / 3 * std::pow(std::sin(gamma), 3) / (2 * gamma - std::sin(2 * gamma));
}

}  // namespace

// A few roundings: 1e-15.
TEST(HardKinetics, DrumsNearlyEmptyAndNearlyFull) {
  const double gamma = 1e-6;
  const long double sine = std::sin((long double)gamma),
                    distance = 4.0L / 3 * sine * sine * sine / long_x_minus_sin(2.0L * gamma);
  hard_cases::check(
      {"kinetics", "centroid of a charge of half angle 1e-6",
       "2 gamma - sin 2 gamma is 1e-18, terms are 1e-6", "formula (12)",
       hard_cases::relative(naive_centroid(gamma), distance),
       hard_cases::relative(centroid_distance(kinetics::planetary::segment_of_half_angle(gamma)), distance),
       1e-15});
  hard_cases::check(
      {"kinetics", "centroid of a charge of half angle 1e-120", "its area is no number any more",
       "formula (12)", hard_cases::relative(naive_centroid(1e-120), 1),
       hard_cases::relative(centroid_distance(kinetics::planetary::segment_of_half_angle(1e-120)), 1),
       1e-15});
  hard_cases::check({"kinetics", "filling of a half angle of 1e-6", "the area's formula subtracts equals",
                     "(gamma - sin gamma cos gamma) / pi",
                     hard_cases::relative((gamma - std::sin(gamma) * std::cos(gamma)) / machines::pi,
                                          long_x_minus_sin(2.0L * gamma) / (2 * pi_l)),
                     hard_cases::relative(kinetics::planetary::segment_of_half_angle(gamma).filling,
                                          long_x_minus_sin(2.0L * gamma) / (2 * pi_l)),
                     1e-15});
  const double filling = 1e-20;
  hard_cases::check({"kinetics", "half angle of a filling of 1e-20", "the area's formula subtracts equals",
                     "bisection of gamma - sin gamma cos gamma",
                     hard_cases::relative(naive_half_angle(filling), half_angle_of_small_share(filling)),
                     hard_cases::relative(kinetics::planetary::segment_of_filling(filling).half_angle_rad,
                                          half_angle_of_small_share(filling)),
                     1e-15});
  hard_cases::check(
      {"kinetics", "opening of a drum full but for 1e-20", "1 - 1e-20 is 1",
       "pi less the half angle of the filling",
       hard_cases::relative(machines::pi - naive_half_angle(1 - filling), half_angle_of_small_share(filling)),
       hard_cases::relative(kinetics::planetary::segment_of_void(filling).opening_rad,
                            half_angle_of_small_share(filling)),
       1e-15});
}

// The charge's moment of a drum full but for 1e-12: q = rho L (2/3) (r sin delta)^3, by the void's half
// angle.
TEST(HardKinetics, MomentOfANearlyFullDrum) {
  auto mill = machines::printed_planetary();
  mill.charge.half_angle_rad.reset();
  const double share = 1e-12;
  mill.charge.void_fraction = share;
  const auto body = planetary_charge_body(mill);
  const long double sine = std::sin(half_angle_of_small_share(share));
  const long double q = 4600.0L * 2 / 3 * sine * sine * sine * 0.1L * 0.1L * 0.1L;
  const double naive_gamma = naive_half_angle(1 - share);
  const double naive_q = 4600 * machines::pi * 0.01 * (1 - share) * 0.1 * naive_centroid(naive_gamma);
  hard_cases::check({"kinetics", "first moment of a drum full but for 1e-12",
                     "mass times a centroid that is the rest of a cancellation", "mass times (12)",
                     hard_cases::relative(naive_q, q), hard_cases::relative(body.first_moment_kg_m, q),
                     2e-15});
}

// The singular value of the speed ratio, E11 of the paper: pulleys of nearly one size.
TEST(HardKinetics, SpeedRatioThroughOne) {
  double naive = 0, ours = 0;
  for (const double step : {1e-14, 1e-12, 1e-9, -1e-14, -1e-12, -1e-9}) {
    auto mill = machines::printed_planetary();
    const double c = 1 + step;
    std::get<kinetics::PlanetaryRatios>(mill.geometry).c = c;
    const long double exact = ((long double)c - 1) / c;
    naive = std::max(naive, hard_cases::relative(1 - 1 / c, exact));
    ours = std::max(ours, hard_cases::relative(planetary_geometry(mill).drum_speed_ratio, exact));
  }
  hard_cases::check({"kinetics", "drum's speed beside a speed ratio of one", "the drum stands still at c = 1",
                     "omega / Omega = 1 - 1 / c", naive, ours, 1e-15});
}

// At sin(phi) = 0 (60) divides by zero; what is told is the principal value, F'(phi) / (ecc cos phi), here
// with the derivative of the force's trigonometric polynomial. 1e-5: both sides are taken 1e-3 rad apart.
TEST(HardKinetics, StiffnessOfTheClosedChainAtItsPoles) {
  auto mill = machines::laboratory();
  mill.convention = kinetics::Convention::published;
  mill.charge_relative_speed_rad_s = -2 * mill.speed_rad_s;  // the motion repeats every turn
  constexpr int n = 36;
  const auto loads = compute_loads(mill, machines::effects_without(mill, {}), {1, n});
  const Eigen::ArrayXd& force = loads.quantity("spring_force_from_moments").values;
  const Eigen::ArrayXd& stiffness = loads.quantity("K_star").values;
  double naive = 0, ours = 0;
  for (const int at : {0, n / 2}) {
    long double slope = 0;
    for (int k = 1; k < n / 2; ++k)
      for (int i = 0; i < n; ++i)
        slope += 2.0L / n * k * force[i] * std::sin(2 * pi_l * (k * (i - at) % n) / n);
    const long double exact = slope / ((long double)mill.eccentricity_m * (at == 0 ? 1 : -1));
    ours = std::max(ours, hard_cases::relative(stiffness[at], exact));
    naive = std::max(
        naive, hard_cases::relative(force[at] / (mill.eccentricity_m * std::sin(loads.phi_rad[at])), exact));
  }
  hard_cases::check({"kinetics", "stiffness (60) at the poles of the closed chain", "sin(phi) = 0 divides",
                     "formula (60)", naive, ours, 1e-5});
}

// No circle has no direction: forces are those of one mass carried along by the eccentric.
TEST(HardKinetics, CircleOfZeroRadius) {
  auto mill = machines::laboratory();
  mill.charge_offset_m = 0;
  const auto loads = compute_loads(
      mill, {"charge_translation", "charge_centripetal", "charge_coriolis", "charge_relative"}, {1, 36});
  const Eigen::Vector2d to_charge(mill.charge_offset_m, 0);
  const Eigen::Vector2d unit =
      to_charge / std::sqrt(to_charge.x() * to_charge.x() + to_charge.y() * to_charge.y());
  const long double exact = 20.0L * 0.004L * 151.844L * 151.844L;
  double ours = 0;
  for (const double R : loads.quantity("R_E").values) ours = std::max(ours, hard_cases::relative(R, exact));
  const double naive_N = 20 * 0.004 * 151.844 * 151.844 * unit.norm();
  hard_cases::check({"kinetics", "charge on a circle of zero radius", "the direction to its centre is 0 / 0",
                     "unit vector p / |p|", hard_cases::relative(naive_N, exact), ours, 1e-14});
}

// An angle of 6e6 rad is known to 5e-10 in double precision, no more.
TEST(HardKinetics, AMillionPeriods) {
  const auto mill = machines::laboratory();
  constexpr int per_turn = 36, turns = 1'000'000;
  constexpr Eigen::Index last = Eigen::Index(turns) * per_turn - per_turn;
  const auto at = kinetics::vibratory::steady_instants(mill, {turns, per_turn}, last, per_turn);
  double naive_angle = 0;
  for (Eigen::Index i = 0; i < last; ++i) naive_angle += 2 * machines::pi / per_turn;
  double naive = 0, ours = 0;
  const long double ratio = kinetics::vibratory::charge_speed_ratio(mill);
  for (int i = 0; i < per_turn; ++i, naive_angle += 2 * machines::pi / per_turn) {
    const long double phi = 2 * pi_l * i / per_turn;  // whole turns left out
    const long double chi = (long double)(machines::pi - mill.charge_initial_angle_rad) +
                            ratio * 2 * pi_l * (last + i) / per_turn;
    ours = std::max({ours, double(std::abs(at.along_phi(0, i) - std::cos(phi))),
                     double(std::abs(at.along_phi(1, i) + std::sin(phi))),
                     double(std::abs(at.along_chi(0, i) - std::cos(chi)))});
    naive = std::max(naive, double(std::abs(std::cos(naive_angle) - std::cos(phi))));
  }
  hard_cases::check({"kinetics", "directions after a million periods", "the angle has grown to 6e6 rad",
                     "angle summed step by step", naive, ours, 2e-9});
}
