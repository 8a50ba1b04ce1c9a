/// The pressure that a port's channels make together, put together again and compared with the exact one.
#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "tests/unit/pipelines/examples/bodies.h"

namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;
using pipelines::BodyLoads;
using pipelines::LoadCollector;
using pipelines::LoadedBody;

constexpr double degree_rad = M_PI / 180;
constexpr int n_directions = 16;

/// A seat and a bore under the same pattern.
LoadedBody body(double half_angle_rad, int highest) {
  LoadedBody result{"ring",
                    {bodies::port("outside", meshes::Port::Kind::seat, 1, {-0.02, 0.02}, 0.05),
                     bodies::port("inside", meshes::Port::Kind::bore, 2, {-0.03, 0.03}, 0.04, {0.01, 0})},
                    {{"", {}, {}}},
                    {}};
  pipelines::PressureModel model;
  model.pattern.half_angle_rad = half_angle_rad;
  model.highest_harmonic = highest;
  for (const auto& port : result.ports) result.pressures[port.name] = model;
  return result;
}

ArrayXd directions() {
  return ArrayXd::LinSpaced(n_directions, 0, 2 * M_PI * (n_directions - 1) / n_directions) + 0.1;
}

Array2Xd pointing(const ArrayXd& angle, const ArrayXd& size) {
  Array2Xd f(2, angle.size());
  f.row(0) = (size * angle.cos()).transpose();
  f.row(1) = (size * angle.sin()).transpose();
  return f;
}

/// Forces of 1000 to 1300 N round the circle, made of three effects that partly cancel.
ArrayXd sizes() {
  return 1000 + 20 * ArrayXd::LinSpaced(n_directions, 0, n_directions - 1);
}

BodyLoads loads_at(const LoadedBody& loaded, const std::string& port) {
  const auto whole = pointing(directions(), sizes());
  const auto across = pointing(directions() + 1.2, 3 * sizes());
  LoadCollector collector(loaded, {"a", "b", "c"}, n_directions, 1000);
  collector.force(port, 0, 0.25 * whole + across);
  collector.force(port, 1, 0.75 * whole);
  collector.force(port, 2, -across);
  collector.pressure(port);
  return collector.finish();
}

/// Pressure in units of |F| / (pi R b) from the channels: n = 1 pushes the way of the force's sign.
double pressure(const BodyLoads& loads, const std::string& port, bool is_seat, Eigen::Index instant,
                double theta) {
  double sum = 0;
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
    const double value = loads.history.values(Eigen::Index(k), instant);
    if (const auto* harmonic = std::get_if<fem::SeatPressure>(&loads.unit_loads[k].shape)) {
      const double angle = harmonic->harmonic * theta;
      const bool cosine = harmonic->phase == fem::SeatPressure::Phase::cosine;
      sum += value * harmonic->coefficient * (cosine ? std::cos(angle) : std::sin(angle));
    }
  }
  // An outer seat is pushed inwards: +x is carried by pressure at theta = 180 degrees. A bore: at 0.
  const double sign = is_seat ? -1 : 1;
  sum += sign * bodies::course(loads, port + ".fx")[instant] * std::cos(theta);
  sum += sign * bodies::course(loads, port + ".fy")[instant] * std::sin(theta);
  return sum / sizes()[instant];
}

/// P (cos t - cos a), with P from the force that it has to carry.
double exact(double half_angle, double t) {
  t = std::abs(std::remainder(t, 2 * M_PI));
  if (t > half_angle) return 0;
  return M_PI * (std::cos(t) - std::cos(half_angle)) /
         (half_angle - std::sin(half_angle) * std::cos(half_angle));
}

/// What the harmonics above `highest` add anywhere, at most: the sum of their sizes; and its root mean square
/// over the circle (Parseval).
struct LeftOut {
  double bound = 0, rms = 0;
};

LeftOut left_out(const pipelines::PressurePattern& pattern, int highest) {
  constexpr int n_summed = 4096;
  const double a = pattern.half_angle_rad;
  LeftOut result;
  for (int n = highest + 1; n <= n_summed; ++n) {
    const double c = n == 1 ? 0 : pipelines::pattern_coefficient(pattern, n);
    result.bound += std::abs(c);
    result.rms += c * c / 2;
  }
  // The kinks at +-a leave harmonics of 2 sin(a) / (a - sin(a) cos(a)) / n^2 and higher orders in 1 / n, for
  // which these are doubled; the sum of 1 / n^2 beyond n_summed is below 1 / n_summed.
  result.bound += 4 * std::sin(a) / (a - std::sin(a) * std::cos(a)) / n_summed;
  result.rms = std::sqrt(result.rms);
  return result;
}

struct Case {
  const char* port;
  int half_angle_deg, highest;
};

class PressureRound : public testing::TestWithParam<Case> {};

TEST_P(PressureRound, IsTheExactOneButForTheHarmonicsLeftOut) {
  const auto [port, half_angle_deg, highest] = GetParam();
  const double a = half_angle_deg * degree_rad;
  const bool is_seat = std::string(port) == "outside";
  const auto loaded = body(a, highest);
  const auto loads = loads_at(loaded, port);
  const auto [bound, rms] = left_out(loaded.pressures.at(port).pattern, highest);
  constexpr int n_places = 4096;
  for (Eigen::Index i = 0; i < n_directions; ++i) {
    // Opposite the force on an outer surface, along it in a bore.
    const double centre = directions()[i] + (is_seat ? M_PI : 0);
    double worst = 0, squares = 0;
    for (int k = 0; k < n_places; ++k) {
      const double theta = 2 * M_PI * k / n_places;
      const double error = pressure(loads, port, is_seat, i, theta) - exact(a, theta - centre);
      worst = std::max(worst, std::abs(error));
      squares += error * error;
    }
    EXPECT_LE(worst, bound * (1 + 1e-9)) << "direction " << i;
    // The kinks put at least a fifth of the bound's sum of sizes in phase: a bound, but no idle one.
    EXPECT_GE(worst, bound / 5) << "direction " << i;
    // Sampling at 4096 places sees the kinks to 1/4096^2.
    EXPECT_NEAR(std::sqrt(squares / n_places), rms, 1e-6) << "direction " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(ports, PressureRound,
                         testing::Values(Case{"outside", 90, 0}, Case{"outside", 90, 4},
                                         Case{"outside", 90, 12}, Case{"inside", 90, 4},
                                         Case{"inside", 90, 8}, Case{"outside", 60, 5}, Case{"inside", 60, 8},
                                         Case{"outside", 120, 3}, Case{"inside", 120, 7}),
                         [](const auto& test) {
                           return test.param.port + std::to_string(test.param.half_angle_deg) + "_to_" +
                                  std::to_string(test.param.highest);
                         });

// Odd harmonics turn over with the port's kind, even ones do not: they must not be left out where the arc is
// not half the circle.
TEST(PressureShares, OddHarmonicsExistBesideAHalfCircleOnly) {
  EXPECT_FALSE(bodies::has(loads_at(body(90 * degree_rad, 5), "outside"), "outside.p3c"));
  const auto wide = loads_at(body(120 * degree_rad, 5), "outside");
  EXPECT_TRUE(bodies::has(wide, "outside.p3c"));
  EXPECT_TRUE(bodies::has(wide, "outside.p5s"));
  EXPECT_FALSE(bodies::has(wide, "outside.p6c"));
  EXPECT_FALSE(bodies::has(wide, "outside.p1c")) << "that is fx, fy";
}

// |F| cos(n beta) is not linear in the effects; the shares still add up, and each is F_e . f.
TEST(PressureShares, AddUpExactly) {
  const auto loads = loads_at(body(60 * degree_rad, 6), "inside");
  const auto& h = loads.history;
  Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(h.values.rows(), h.values.cols());
  for (const auto& part : h.by_effect) sum += part;
  EXPECT_LT(bodies::largest(sum - h.values), 1e-15 * 3 * 1300 * 4) << "a few last bits of the parts";
  const ArrayXd p0 = bodies::course(loads, "inside.p0c");
  EXPECT_LT(bodies::largest(p0 - sizes()), 1e-12 * 1300);
  EXPECT_LT(bodies::largest(bodies::part(loads, "b", "inside.p0c") - 0.75 * sizes()), 1e-12 * 1300);
  const ArrayXd of_a = (0.25 + 3 * std::cos(1.2)) * sizes();
  EXPECT_LT(bodies::largest(bodies::part(loads, "a", "inside.p0c") - of_a), 1e-12 * 1300);
  // Each effect on its own would claim |F_e|: 3.2 + 0.75 + 3 times the force.
  EXPECT_LT(of_a.maxCoeff(), 1.4 * sizes().maxCoeff());
}

// Where no force acts there is no direction either: nothing is pushed, nothing is NaN.
TEST(PressureShares, NoForceNoPressure) {
  const auto loaded = body(90 * degree_rad, 4);
  Array2Xd f = pointing(directions(), sizes());
  f.col(3).setZero();
  LoadCollector collector(loaded, {"a"}, n_directions, 1000);
  collector.force("outside", 0, f);
  collector.pressure("outside");
  const auto loads = collector.finish();
  EXPECT_TRUE(loads.history.values.isFinite().all());
  EXPECT_EQ(bodies::largest(loads.history.values.col(3)), 0);
}

// With a clearance the arc follows from the largest force, 1300 N on 40 mm: 0.5 MN m / m^2 and 226 GPa leave
// what a scene with that half angle has. Unit loads do not know the force, so that other operating points
// share them.
TEST(PressureOfClearance, IsThatOfItsHalfAngle) {
  auto loaded = body(90 * degree_rad, 8);
  loaded.plane_modulus_Pa = 226e9;
  loaded.pressures["outside"].clearance_m = 10e-6;
  const auto loads = loads_at(loaded, "outside");
  const double a = loads.pressures.at("outside").pattern.half_angle_rad;
  const double Q = 1300 / 0.04, dR = 5e-6, R = 0.05;
  EXPECT_NEAR(a, std::sqrt(4 * Q * R * R / dR / (M_PI * 226e9)) / R, 0.02 * a) << "Hertz";
  EXPECT_NEAR(loads.pressures.at("outside").half_angles.least_rad, 0.75 * a, 1e-12);
  const auto same = loads_at(body(a, 8), "outside");
  ASSERT_EQ(loads.unit_loads.size(), same.unit_loads.size());
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
    const auto* own = std::get_if<fem::SeatPressure>(&loads.unit_loads[k].shape);
    const auto* other = std::get_if<fem::SeatPressure>(&same.unit_loads[k].shape);
    if (own == nullptr) continue;
    EXPECT_EQ(own->coefficient, 1);
    const auto i = Eigen::Index(k);
    EXPECT_LT(bodies::largest(loads.history.values.row(i) - other->coefficient * same.history.values.row(i)),
              1e-9 * 1300)
        << loads.unit_loads[k].channel;
  }
}

}  // namespace
