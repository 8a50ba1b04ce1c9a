#include "kinetics/series/harmonics.h"
#include "kinetics/values/constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using Eigen::ArrayXd;
using kinetics::line_spectrum;

using kinetics::pi;

ArrayXd angles(int turns, int n) {
  return ArrayXd::LinSpaced(n, 0, n - 1) * (2 * pi * turns / n);
}

ArrayXd noise(int n) {
  std::mt19937 generator(5);
  std::normal_distribution<> draw(3, 10);
  return ArrayXd::NullaryExpr(n, [&] { return draw(generator); });
}

}  // namespace

// The phase is a lag: the crest of line n is at n angle = phase.
TEST(Harmonics, AmplitudePhaseAndOrderOfAKnownSeries) {
  const ArrayXd angle = angles(4, 240);
  const auto spectrum = line_spectrum(
      7 + 2 * (angle - 0.6).cos() + 0.5 * (0.25 * angle + 1.1).cos() + (3 * angle).sin(), 4, 20);
  EXPECT_NEAR(spectrum.mean, 7, 1e-13);
  for (const auto& line : spectrum.lines) {
    const double amplitude = line.order == 1 ? 2 : line.order == 0.25 ? 0.5 : line.order == 3 ? 1 : 0;
    const double phase_rad = line.order == 1 ? 0.6 : line.order == 0.25 ? -1.1 : line.order == 3 ? pi / 2 : 0;
    EXPECT_NEAR(line.amplitude, amplitude, 1e-13) << line.order;
    EXPECT_NEAR(line.phase_rad, phase_rad, 1e-12) << line.order;
  }
  EXPECT_EQ(spectrum.lines[3].order, 1);
}

// All lines together are the series, for even and odd numbers of instants: the last line of an even number is
// the one that a wrong factor of two shows in.
TEST(Harmonics, LinesAddUpToTheSeries) {
  for (const int n : {1, 2, 7, 64, 101}) {
    const ArrayXd values = noise(n);
    const auto spectrum = line_spectrum(values, 1, n / 2);
    ArrayXd sum = ArrayXd::Constant(n, spectrum.mean);
    for (const auto& line : spectrum.lines)
      sum += line.amplitude * (line.order * angles(1, n) - line.phase_rad).cos();
    EXPECT_LE(machines::largest(sum - values), 1e-12 * machines::largest(values)) << n;
  }
}

TEST(Harmonics, Parseval) {
  for (const int n : {63, 64}) {
    const ArrayXd values = noise(n);
    const auto spectrum = line_spectrum(values, 3, n / 2);
    double power = spectrum.mean * spectrum.mean;
    for (std::size_t k = 1; k <= spectrum.lines.size(); ++k)
      power += std::pow(spectrum.lines[k - 1].amplitude, 2) * (int(2 * k) == n ? 1 : 0.5);
    EXPECT_NEAR(power / values.square().mean(), 1, 1e-13);
  }
}

// The laboratory mill's reaction: weights, then the drive's order 1, and the slow circulation of the charge
// at (omega_e + omega_r) / omega_e = -1/20. Nothing else with the pitch held.
TEST(Harmonics, OrdersOfTheMill) {
  const auto mill = machines::laboratory();
  const auto loads = compute_loads(
      mill, machines::effects_without(mill, {"charge_lag", "pitch", "charge_follows_pitch"}), {20, 60});
  const auto spectrum = line_spectrum(loads.quantity("X_E").values, 20, 60);
  for (const auto& line : spectrum.lines)
    if (line.order != 1 && line.order != 0.05) {
      EXPECT_LE(line.amplitude, 1e-12 * spectrum.lines[19].amplitude) << line.order;
    }
  EXPECT_NEAR(spectrum.lines[0].amplitude, 20 * 0.03 * std::pow(151.844 - 159.4362, 2), 1e-9);
}

TEST(Harmonics, PolarSeries) {
  ArrayXd fx(6), fy(6);
  fx << 3, 0, -1, 0, -0.0, -2;
  fy << 4, 2, -0.0, -5, 0, 2;
  const auto series = kinetics::polar(fx, fy);
  const double magnitude[] = {5, 2, 1, 5, 0, std::sqrt(8)};
  const double direction[] = {std::atan2(4, 3), pi / 2, pi, -pi / 2, 0, 3 * pi / 4};
  for (int i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(series.magnitude[i], magnitude[i]) << i;
    EXPECT_DOUBLE_EQ(series.direction_rad[i], direction[i]) << i;
  }
}

TEST(Harmonics, WrongInputIsRefused) {
  ArrayXd with_nan = ArrayXd::Ones(8);
  with_nan[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(line_spectrum(with_nan, 1, 2), std::invalid_argument);
  EXPECT_THROW(line_spectrum(ArrayXd(), 1, 0), std::invalid_argument);
  EXPECT_THROW(line_spectrum(ArrayXd::Ones(8), 0, 2), std::invalid_argument);
  EXPECT_THROW(line_spectrum(ArrayXd::Ones(8), 1, 5), std::invalid_argument);
  EXPECT_THROW(line_spectrum(ArrayXd::Ones(8), 1, -1), std::invalid_argument);
  EXPECT_THROW(kinetics::polar(ArrayXd::Ones(2), ArrayXd::Ones(3)), std::invalid_argument);
  EXPECT_THROW(kinetics::polar(ArrayXd::Ones(8), with_nan), std::invalid_argument);
}
