// Few instants, instants that meet a load always at the same place, a million of them. References: closed
// forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kinetics/series/harmonics.h"
#include "kinetics/table/load_table.h"
#include "kinetics/values/machine_refused.h"
#include "kinetics/vibratory/torus_extremes.h"
#include "kinetics/vibratory_mill.h"
#include "pipelines/judge/estimates/error_budget.h"
#include "tests/hard/hard_case.h"
#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The share of the largest stress that is neither found nor told, where a load turns around a shaft once in
/// n instants: bending at an angle between two of them.
struct Missing {
  double naive = 0, ours = 0;
};
Missing missing_at(int n) {
  Missing missing;
  for (int part = 0; part <= 12; ++part) {
    const double angle = 2 * M_PI / n * part / 12;
    fem::UnitResponses responses;
    responses.nodes.n = 1;
    responses.nodes.xyz_m = {0, 0, 0};
    responses.channels = {"seat.fx", "seat.fy"};
    responses.stress_Pa = {0, 0, std::cos(angle), 0, 0, 0, 0, 0, std::sin(angle), 0, 0, 0};
    pipelines::BodyLoads loads;
    loads.history.values.resize(2, n);
    for (int i = 0; i < n; ++i)
      loads.history.values.col(i) << std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n);
    const auto size = [&](int i) { return std::abs(std::cos(2 * M_PI * ((i + n) % n) / n - angle)); };
    int largest = 0;
    for (int i = 0; i < n; ++i)
      if (size(i) > size(largest)) largest = i;
    const auto budget = self_estimate({{{0, 1.0}}, largest}, responses, loads, {}, 0);
    const double before = size(largest - 1), here = size(largest), after = size(largest + 1);
    const double curvature = before - 2 * here + after;
    const double parabola = curvature < 0 ? (before - after) * (before - after) / (-8 * curvature) : 0;
    missing.ours = std::max(missing.ours, 1 - here - budget.of("time_sampling"));
    missing.naive = std::max(missing.naive, 1 - here - parabola);
  }
  return missing;
}

}  // namespace

// The trigonometric polynomial has a load that turns once exactly; its crest is looked for in sixteenths of
// two steps: 1e-3.
TEST(HardTime, ThreeToEightInstantsOfALoadThatTurns) {
  for (const int n : {3, 4, 5, 8}) {
    const auto missing = missing_at(n);
    hard_cases::check({"time",
                       std::to_string(n) + " instants of a load that turns: what is missing and not told",
                       "the size of the stress turns its sign between the instants",
                       "parabola through three values", missing.naive, missing.ours, 1e-3});
  }
}

// A harmonic of order 8 met eight times per turn is a constant, here zero.
TEST(HardTime, AliasedHarmonic) {
  const kinetics::LoadTable table{100,
                                  {{"mesh", "gear", "fx", "N", kinetics::HarmonicCourse{0, 5, 8, M_PI / 2}}}};
  double naive = 0, ours = 1;
  for (int i = 0; i < 8; ++i)
    naive = std::max(naive, std::abs(5 * std::cos(8 * 2 * M_PI * i / 8 - M_PI / 2)));
  try {
    compute_loads(table, {"mesh"}, {1, 8});
  } catch (const kinetics::MachineRefused&) {
    ours = 0;
  }
  hard_cases::check({"time", "harmonic with one instant per period",
                     "instants meet it always at the same place", "its values at the instants",
                     hard_cases::relative(naive, 5), ours, 0});
  EXPECT_NO_THROW(compute_loads(table, {"mesh"}, {1, 17}));
}

// A shock of 5 degrees in a logger's samples, between instants 45 degrees apart.
TEST(HardTime, ShockBetweenTheInstants) {
  kinetics::SampledCourse samples;
  samples.angle_rad = Eigen::ArrayXd::LinSpaced(360, 0, 359) * M_PI / 180;
  samples.values = Eigen::ArrayXd::Ones(360);
  samples.values.segment(20, 5).setConstant(10);
  const kinetics::LoadTable table{100, {{"shock", "gear", "fx", "N", samples}}};
  bool is_told = false;
  try {
    compute_loads(table, {"shock"}, {1, 8});
  } catch (const kinetics::MachineRefused& refused) {
    is_told = std::string(refused.what()).find("between the instants") != std::string::npos;
  }
  double largest = 0;
  for (int i = 0; i < 8; ++i) largest = std::max(largest, samples.values[45 * i]);
  hard_cases::check({"time", "shock between two instants: not found and not told",
                     "eight instants pass it by", "largest value at the instants",
                     hard_cases::relative(largest, 10), is_told ? 0 : hard_cases::relative(largest, 10),
                     1e-3});
}

// One turn of a motion that hardly changes from turn to turn and never repeats: charge and chamber are
// opposite all the time. Some hundred turns later their forces are parallel, |R| = (m1 ecc + m r) w^2.
TEST(HardTime, WindowShorterThanThePeriod) {
  auto mill = machines::laboratory();
  mill.charge_relative_speed_rad_s = -mill.speed_rad_s * (std::sqrt(5.0) - 1) / 200;
  mill.charge_initial_angle_rad = 0;
  const std::vector<std::string> effects{"structure_inertia", "charge_centripetal"};
  const double exact = (30 * 0.004 + 20 * 0.03) * std::pow(mill.speed_rad_s, 2);
  const auto window = compute_loads(mill, effects, {1, 16});
  hard_cases::check(
      {"time", "largest reaction of a motion that never repeats", "sixteen instants of one turn",
       "largest value of the window", hard_cases::relative(window.quantity("R_E").values.maxCoeff(), exact),
       hard_cases::relative(torus_extremes(mill, effects, {"R_E"})[0].most.value, exact), 1e-13});
}

// Sums of a million terms of size one: rounding in them all, 1e-12.
TEST(HardTime, HarmonicOfAMillionInstants) {
  constexpr Eigen::Index n = 1'000'000;
  Eigen::ArrayXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) values[i] = std::cos(2 * M_PI * double(2 * i % n) / double(n) - 0.5);
  const auto spectrum = kinetics::line_spectrum(values, 1, 2);
  double before = std::cos(4 * M_PI / n), cosine = 1, sum = 0;
  double sine = 0, sine_before = -std::sin(4 * M_PI / n), sine_sum = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    sum += values[i] * cosine, sine_sum += values[i] * sine;
    const double next = 2 * std::cos(4 * M_PI / n) * cosine - before;
    const double sine_next = 2 * std::cos(4 * M_PI / n) * sine - sine_before;
    before = cosine, cosine = next, sine_before = sine, sine = sine_next;
  }
  hard_cases::check({"time", "harmonic of a million instants",
                     "its cosines by recurrence drift with the square of the steps", "Goertzel's recurrence",
                     hard_cases::relative(2.0 / n * std::hypot(sum, sine_sum), 1),
                     hard_cases::relative(spectrum.lines[1].amplitude, 1), 1e-12});
}
