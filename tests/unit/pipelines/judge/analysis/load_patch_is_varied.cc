/// The entry `load_patches` on one point whose stress is known in closed form.
#include "pipelines/judge/analysis/load_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace pipelines;

namespace {

constexpr double degree = M_PI / 180;

/// p_n / p_1 of cos t - cos a over |t| < a, by the midpoint rule: 2e4 steps leave 1e-8.
double coefficient(double half_angle_rad, int n) {
  constexpr int steps = 20000;
  const auto integral = [&](int order) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double t = half_angle_rad * (i + 0.5) / steps;
      sum += (std::cos(t) - std::cos(half_angle_rad)) * std::cos(order * t);
    }
    return sum;
  };
  return (n == 0 ? 0.5 : 1) * integral(n) / integral(1);
}

/// Uniaxial stress of one unit of each coefficient, times the force of 1 N along x: n = 0, 1, 2, 3, 4.
constexpr double per_coefficient[] = {2.0, 7.0, -3.0, 1.0, 0.5};
constexpr double force_N[] = {10, 40, 25};

/// A point under a seat pressure, its zone at theta = 0.
Judged at_one_point(const PressureModel& model) {
  Judged analysis;
  analysis.loads.pressures["seat"] = model;
  auto& responses = analysis.responses;
  responses.nodes.n = 1;
  responses.nodes.xyz_m = {0, 0, 0};
  const auto add = [&](const std::string& channel, const auto& shape, double stress_Pa) {
    analysis.loads.unit_loads.push_back({channel, shape});
    analysis.loads.history.channels.push_back({channel, "N"});
    responses.channels.push_back(channel);
    responses.stress_Pa.insert(responses.stress_Pa.end(), {stress_Pa, 0, 0, 0, 0, 0});
  };
  add("seat.fx", fem::SurfaceResultant{}, per_coefficient[1]);
  for (int n = 0; n <= highest_solved(model); ++n) {
    const double c = solved_coefficient(model, n);
    if (c == 0) continue;
    fem::SeatPressure shape;
    shape.harmonic = n;
    shape.coefficient = c;
    add("seat.p" + std::to_string(n) + "c", shape, c * per_coefficient[n]);
  }
  const auto n_channels = Eigen::Index(responses.channels.size());
  analysis.loads.history.values.resize(n_channels, 3);
  for (Eigen::Index i = 0; i < 3; ++i) analysis.loads.history.values.col(i) = force_N[i];
  analysis.places.excluded = {0};
  analysis.peak.instant = 1;
  const Stress stress = stress_at(responses, analysis.loads.history, 0, 1);
  analysis.peak.value_Pa = von_mises_Pa(stress);
  analysis.envelope.von_mises = {{analysis.peak.value_Pa}, {1}, {stress}};
  return analysis;
}

double stress_Pa(double half_angle_rad, int highest) {
  double sum = per_coefficient[1];
  for (int n = 0; n <= highest; ++n)
    if (n != 1) sum += coefficient(half_angle_rad, n) * per_coefficient[n];
  return std::abs(sum) * force_N[1];
}

PressureModel model_of(double half_angle_rad, int highest, HalfAngles range) {
  PressureModel model;
  model.pattern.half_angle_rad = half_angle_rad;
  model.highest_harmonic = highest;
  model.half_angles = range;
  return model;
}

/// What harmonics above the fourth bring, which are not solved: the third has 1 Pa per newton and
/// coefficient, the fourth 0.5, and A / (n^2 - 1) + B goes on from both; B times the largest pressure that
/// these harmonics make.
double above_fourth_Pa(double half_angle_rad) {
  constexpr double level = (0.5 * 15 - 1.0 * 8) / (15 - 8), falling = (0.5 - level) * 15;
  constexpr int n_terms = 200, n_places = 400;
  std::vector<double> c;
  double sum = 0, most = 0;
  for (int n = 5; n < n_terms; ++n) {
    c.push_back(coefficient(half_angle_rad, n));
    sum += std::abs(c.back()) * falling / (n * n - 1.0);
  }
  for (int i = 0; i <= n_places; ++i) {
    double pressure = 0;
    for (int n = 5; n < n_terms; ++n) pressure += c[std::size_t(n - 5)] * std::cos(n * M_PI * i / n_places);
    most = std::max(most, std::abs(pressure));
  }
  return (sum + std::abs(level) * most) * force_N[1];
}

}  // namespace

// The entry is the stress at the worst half angle of the range less that of the scene's, to the quadrature of
// the coefficients, and what harmonics above the fourth bring there.
TEST(LoadPatch, EntryIsTheStressOfAnotherContact) {
  for (const double half : {60 * degree, 80 * degree, 100 * degree}) {
    const HalfAngles range{0.75 * half, 1.25 * half};
    auto analysis = at_one_point(model_of(half, 4, range));
    const double here = stress_Pa(half, 4);
    EXPECT_NEAR(analysis.peak.value_Pa, here, 1e-6 * here);
    double up = 0, down = 0;
    for (const double share : {0.0, 1 / 3.0, 2 / 3.0, 1.0}) {
      const double other = range.least_rad + share * (range.most_rad - range.least_rad);
      const double change = stress_Pa(other, 4) - here;
      up = std::max(up, change + above_fourth_Pa(other));
      down = std::max(down, above_fourth_Pa(other) - change);
    }
    add_load_patch_error(analysis);
    EXPECT_NEAR(analysis.peak.errors.of("load_patches"), std::max(up, down), 2e-3 * here) << half / degree;
    ASSERT_EQ(analysis.peak.errors.model.size(), 1u);
    EXPECT_EQ(analysis.peak.errors.model[0].condition,
              "if seat presses on " + std::to_string(std::lround(1.5 * half / degree)) + " to " +
                  std::to_string(std::lround(2.5 * half / degree)) + " degrees in all");
  }
}

// Of any point and loads: at the peak the entry, of half the loads half of that, of loads that leave the seat
// alone nothing. Turns red: the part that was not solved by the whole force.
TEST(LoadPatch, ErrorsGoWithTheLoads) {
  auto analysis = at_one_point(model_of(80 * degree, 4, {60 * degree, 100 * degree}));
  add_load_patch_error(analysis);
  const double entry_Pa = analysis.peak.errors.of("load_patches");
  const auto& values = analysis.loads.history.values;
  const StressPoint point{{{0, 1.0}}, 1};
  EXPECT_GT(entry_Pa, 0);
  EXPECT_NEAR(load_patch_error_Pa(analysis, point, values), entry_Pa, 1e-9 * entry_Pa);
  EXPECT_NEAR(load_patch_error_Pa(analysis, point, 0.5 * values), entry_Pa / 2, 1e-9 * entry_Pa);
  EXPECT_EQ(load_patch_error_Pa(analysis, point, 0 * values), 0);
}

// A half-cosine has no n = 3, which all narrower patterns have. Where no response was solved it counts with
// the larger stress of its neighbours 2 and 4, here 3 Pa per newton; solved, next to unloaded, with its own,
// 1 Pa.
TEST(LoadPatch, HarmonicsThatWereNotSolvedAreTakenFromTheirNeighbours) {
  auto model = model_of(M_PI / 2, 4, {40 * degree, 90 * degree});
  auto unsolved = at_one_point(model);
  EXPECT_EQ(unsolved.responses.channels.size(), 4u);  // fx, p0, p2, p4
  EXPECT_EQ(felt_seats(unsolved), std::set<std::string>{"seat"});
  model.solves_missing = true;
  auto solved = at_one_point(model);
  EXPECT_EQ(solved.responses.channels.size(), 5u);
  EXPECT_TRUE(felt_seats(solved).empty());
  EXPECT_NEAR(solved.peak.value_Pa, unsolved.peak.value_Pa, 1e-5 * solved.peak.value_Pa);
  add_load_patch_error(unsolved);
  add_load_patch_error(solved);
  const double c3 = coefficient(40 * degree, 3);
  const double change = stress_Pa(40 * degree, 4) - stress_Pa(M_PI / 2, 4);
  EXPECT_GE(solved.peak.errors.of("load_patches"), std::abs(change));
  EXPECT_GE(unsolved.peak.errors.of("load_patches"), solved.peak.errors.of("load_patches") + c3 * force_N[1]);
  EXPECT_NE(solved.peak.errors.model[0].method.find("if seat presses on 80 to 180 degrees in all"),
            std::string::npos);
}

// A point that feels a five-hundredth of its stress or less from the second harmonic calls for no more.
TEST(LoadPatch, SeatsThatAreNotFeltAreNotSolved) {
  auto analysis = at_one_point(model_of(M_PI / 2, 4, {40 * degree, 90 * degree}));
  analysis.peak.value_Pa *= 1e4;
  EXPECT_TRUE(felt_seats(analysis).empty());
}

// What the charge does on its wall is told apart from the bearings.
TEST(LoadPatch, TheChargeHasItsOwnEntry) {
  auto model = model_of(M_PI / 2, 4, {67.5 * degree, 112.5 * degree});
  auto bearing = at_one_point(model);
  model.is_charge = true;
  auto charge = at_one_point(model);
  add_load_patch_error(bearing);
  add_load_patch_error(charge);
  EXPECT_GT(charge.peak.errors.of("charge_patch"), 0);
  EXPECT_EQ(charge.peak.errors.of("load_patches"), 0);
  EXPECT_EQ(charge.peak.errors.of("charge_patch"), bearing.peak.errors.of("load_patches"));
}

// The force alone has no shape: nothing is varied, and there is no entry.
TEST(LoadPatch, BodiesWithoutPressureHaveNoEntry) {
  auto analysis = at_one_point(model_of(80 * degree, 4, load_zones));
  analysis.loads.unit_loads.resize(1);
  analysis.loads.history.values.conservativeResize(1, Eigen::NoChange);
  analysis.responses.channels.resize(1);
  analysis.responses.stress_Pa.resize(6);
  add_load_patch_error(analysis);
  EXPECT_TRUE(analysis.peak.errors.model.empty());
}
