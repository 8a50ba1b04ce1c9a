/// What harmonics of a pressure that were left out bring, against sums of two thousand of them at points
/// whose stress by each harmonic is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "pipelines/judge/estimates/solved_pressure.h"

using namespace pipelines;

namespace {

constexpr double degree = M_PI / 180;
using Shape = PressurePattern::Kind;

/// Stress per unit of a coefficient: bending of a ring, a place beside a seat, the seat itself.
struct Response {
  const char* name;
  std::function<double(int)> at;
};
const std::vector<Response> responses{{"ring", [](int n) { return 1 / (n * n - 1.0); }},
                                      {"beside", [](int n) { return std::exp(-0.15 * n); }},
                                      {"near", [](int n) { return std::exp(-0.02 * n); }},
                                      {"seat", [](int n) { return std::exp(-0.003 * n); }}};

/// A port at which n = 0, 2 ... `highest` are solved, under a force of 1 N.
BodyLoads loads_of(const PressureModel& model) {
  BodyLoads loads;
  loads.pressures["seat"] = model;
  std::vector<double> values;
  const auto add = [&](int n, fem::SeatPressure::Phase phase, double value) {
    fem::SeatPressure shape;
    shape.harmonic = n;
    shape.coefficient = solved_coefficient(model, n);
    shape.phase = phase;
    loads.unit_loads.push_back({"seat.p" + std::to_string(loads.unit_loads.size()), shape});
    values.push_back(value);
  };
  for (int n = 0; n <= highest_solved(model); ++n) {
    if (solved_coefficient(model, n) == 0) continue;
    add(n, fem::SeatPressure::Phase::cosine, 1);
    if (n > 0) add(n, fem::SeatPressure::Phase::sine, 0);
  }
  loads.history.values = Eigen::Map<Eigen::ArrayXd>(values.data(), Eigen::Index(values.size()));
  return loads;
}

/// Uniaxial unit stress of the channels at an angle from the zone's centre.
std::vector<std::array<double, 6>> unit_at(const BodyLoads& loads, const Response& response, double mean,
                                           double t) {
  std::vector<std::array<double, 6>> unit;
  for (const auto& load : loads.unit_loads) {
    const auto& shape = std::get<fem::SeatPressure>(load.shape);
    const double size = shape.coefficient * (shape.harmonic == 0 ? mean : response.at(shape.harmonic));
    unit.push_back({size * (shape.phase == fem::SeatPressure::Phase::cosine ? std::cos(shape.harmonic * t)
                                                                            : std::sin(shape.harmonic * t)),
                    0, 0, 0, 0, 0});
  }
  return unit;
}

/// The largest sum of c_n S_n cos(n t) over n > highest, and over t.
double left_out(const PressurePattern& pattern, const Response& response, int highest) {
  std::vector<double> terms;
  for (int n = std::max(2, highest + 1); n < 2000; ++n)
    terms.push_back(pattern_coefficient(pattern, n) * response.at(n));
  double most = 0;
  for (int i = 0; i <= 360; ++i) {
    const double t = (i + 0.25) * M_PI / 361;
    double sum = 0;
    for (std::size_t k = 0; k < terms.size(); ++k)
      sum += terms[k] * std::cos((std::max(2, highest + 1) + double(k)) * t);
    most = std::max(most, std::abs(sum));
  }
  return most;
}

double stated(const PressureModel& model, const Response& response, double mean, double t) {
  const auto loads = loads_of(model);
  const auto pressures = solved_pressures(loads);
  const auto& pressure = pressures.at("seat");
  EXPECT_NEAR(pressure.force_N, 1, 1e-14);
  return harmonics_from_Pa({pressure, unit_at(loads, response, mean, t)}, model.pattern,
                           model.highest_harmonic + 1);
}

}  // namespace

// Patterns of which some harmonic vanishes: 36, 45, 60, 72, 90 degrees, and others; whatever angle the point
// is at. The bound is no idle one: at most ten times what is left out, where two harmonics or more were
// solved and something is.
TEST(PressureTail, IsBoundedByThePatternsSeries) {
  for (const auto kind : {Shape::uniform, Shape::cosine})
    for (const double half : {10, 25, 36, 45, 60, 72, 90, 120, 150})
      for (const int highest : {2, 3, 4, 5, 6, 8, 10, 12, 20})
        for (const auto& response : responses) {
          PressureModel model;
          model.pattern = {kind, half * degree};
          model.highest_harmonic = highest;
          const double truth = left_out(model.pattern, response, highest);
          const double here = stated(model, response, 1, 0.3 * half);
          const auto what = std::string(kind == Shape::uniform ? "uniform " : "cosine ") +
                            std::to_string(int(half)) + " degrees to " + std::to_string(highest) + ", " +
                            response.name;
          // A grid of 361 places misses a per cent of a largest sum beside a jump.
          EXPECT_GE(here, truth * 0.99 - 1e-12) << what;
          if (highest < 4 || truth < 1e-3) continue;
          EXPECT_LE(here, 10 * truth) << what;
        }
}

// The mean pressure alone tells a ring's bending by its thickness: sigma_n / sigma_0 = 6 r / ((n^2 - 1) t).
TEST(PressureTail, OfTheMeanPressureAloneIsARings) {
  for (const double factor : {3.0, 12.0, 60.0})
    for (const double half : {45, 60, 90}) {
      PressureModel model;
      model.pattern.half_angle_rad = half * degree;
      model.highest_harmonic = 0;
      model.ring_factor = factor;
      const Response ring{"ring", [&](int n) { return 3 * factor / (n * n - 1.0); }};
      EXPECT_GE(stated(model, ring, 1, 0.2), left_out(model.pattern, ring, 0)) << factor << ' ' << half;
    }
}

// Harmonics that are solved and not meant to load count as left out, by their own stress.
TEST(PressureTail, CountsWhatIsSolvedAndDoesNotLoad) {
  PressureModel model;
  model.highest_harmonic = 0;
  model.solves_missing = true;
  const Response ring = responses[0];
  const double truth = left_out(model.pattern, ring, 0), here = stated(model, ring, 1, 0.2);
  EXPECT_GE(here, truth);
  EXPECT_LE(here, 2 * truth);
}

// A half-cosine under which the third harmonic was not solved: what other half angles bring by it is taken
// from its neighbours, and bounds what a ring, or the place beside a seat, has of it.
TEST(PressureTail, OtherPatternsNeedHarmonicsThatWereNotSolved) {
  PressureModel model;
  const auto loads = loads_of(model);
  const auto pressures = solved_pressures(loads);
  for (const auto& response : responses)
    for (const double half : {40, 60, 75}) {
      const PressurePattern other{Shape::cosine, half * degree};
      double truth = std::abs(pattern_coefficient(other, 3)) * response.at(3);
      truth += left_out(other, response, 4);
      EXPECT_GE(unsolved_Pa({pressures.at("seat"), unit_at(loads, response, 1, 0.1)}, other), truth)
          << response.name << half;
    }
}
