/// The entry `load_patches` on one point whose stress is known in closed form.
#include "pipelines/analysis/load_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

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

/// A point under a seat pressure of that half angle, its zone at theta = 0.
BodyAnalysis at_one_point(double half_angle_rad, int highest) {
  BodyAnalysis analysis;
  PressureModel model;
  model.pattern.half_angle_rad = half_angle_rad;
  model.highest_harmonic = highest;
  analysis.scene.pressures["seat"] = model;
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
  for (int n = 0; n <= highest; ++n) {
    const double c = n == 1 ? 0 : pattern_coefficient(model.pattern, n);
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

double entry_of(BodyAnalysis analysis) {
  add_load_patch_error(analysis);
  return analysis.peak.errors.of("load_patches");
}

}  // namespace

// All harmonics are solved: the entry is the stress at 75 % or 125 % of the half angle less that of the
// scene's, to the quadrature of the coefficients. The narrower contact changes more at 30 and 120 degrees.
TEST(LoadPatch, EntryIsTheStressOfAnotherContact) {
  for (const double half : {30 * degree, 80 * degree, 100 * degree, 120 * degree}) {
    const double here = stress_Pa(half, 4);
    const double wanted =
        std::max(std::abs(stress_Pa(0.75 * half, 4) - here), std::abs(stress_Pa(1.25 * half, 4) - here));
    EXPECT_NEAR(entry_of(at_one_point(half, 4)), wanted, 1e-6 * here) << half / degree;
  }
}

// A half-cosine has no n = 3. At 67.5 degrees the pattern has it, and no response was solved: it counts with
// the larger stress of its neighbours 2 and 4, here 3 Pa per newton.
TEST(LoadPatch, HarmonicsThatWereNotSolvedAreTakenFromTheirNeighbours) {
  const double half = M_PI / 2;
  const double here = stress_Pa(half, 4);
  double changed = 0, unsolved = 0;
  for (const double factor : {0.75, 1.25}) {
    const double c3 = coefficient(factor * half, 3);
    const double without = stress_Pa(factor * half, 4) - c3 * per_coefficient[3] * force_N[1];
    changed = std::max(changed, std::abs(without - here));
    unsolved = std::max(unsolved, std::abs(c3) * std::abs(per_coefficient[2]) * force_N[1]);
  }
  auto analysis = at_one_point(half, 4);
  EXPECT_EQ(analysis.responses.channels.size(), 4u);  // fx, p0, p2, p4
  add_load_patch_error(analysis);
  EXPECT_NEAR(analysis.peak.errors.of("load_patches"), changed + unsolved, 1e-6 * here);
  ASSERT_EQ(analysis.peak.errors.model.size(), 1u);
  EXPECT_NE(analysis.peak.errors.model[0].method.find("neighbours"), std::string::npos);
}

// The force alone has no shape: nothing is varied, and there is no entry.
TEST(LoadPatch, BodiesWithoutPressureHaveNoEntry) {
  auto analysis = at_one_point(80 * degree, 4);
  analysis.loads.unit_loads.resize(1);
  analysis.loads.history.values.conservativeResize(1, Eigen::NoChange);
  analysis.responses.channels.resize(1);
  analysis.responses.stress_Pa.resize(6);
  add_load_patch_error(analysis);
  EXPECT_TRUE(analysis.peak.errors.model.empty());
}

// All round is the widest contact; a uniform pressure stays short of it, where it has no resultant.
TEST(LoadPatch, ContactIsWidenedAtMostAllRound) {
  PressurePattern pattern;
  pattern.half_angle_rad = 160 * degree;
  EXPECT_EQ(with_contact(pattern, 1.25).half_angle_rad, M_PI);
  EXPECT_NEAR(with_contact(pattern, 0.75).half_angle_rad, 120 * degree, 1e-15);
  pattern.kind = PressurePattern::Kind::uniform;
  EXPECT_NEAR(with_contact(pattern, 1.25).half_angle_rad, 170 * degree, 1e-15);
  EXPECT_NO_THROW(pattern_coefficient(with_contact(pattern, 1.25), 2));
}
