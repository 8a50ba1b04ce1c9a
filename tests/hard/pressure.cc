// Pressure round a seat over narrow and nearly full arcs, and under a force that vanishes. References: the
// pattern's integrals by Simpson's rule in long double, closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/scene/values/pressure_pattern.h"
#include "tests/hard/hard_case.h"
#include "tests/unit/pipelines/examples/bodies.h"

namespace {

using pipelines::pattern_coefficient;
using Shape = pipelines::PressurePattern::Kind;

/// The closed form, (1/pi) integral of (cos t - cos a) cos(n t), over that of n = 1.
double naive_cosine(double a, int n) {
  const auto sinc = [&](int k) { return k == 0 ? a : std::sin(k * a) / k; };
  const auto integral = [&](int k) { return sinc(k - 1) + sinc(k + 1) - 2 * std::cos(a) * sinc(k); };
  return (n == 0 ? 0.5 : 1) * integral(n) / integral(1);
}

/// Simpson's rule, (n a / 1e4)^4 / 180 off; cos t - cos a as a product.
long double cosine_integral(long double a, int n) {
  constexpr int pieces = 20'000;
  long double sum = 0;
  for (int i = 0; i <= pieces; ++i) {
    const long double t = a * i / pieces, weight = i == 0 || i == pieces ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * 2 * std::sin((a + t) / 2) * std::sin((a - t) / 2) * std::cos(n * t);
  }
  return sum * a / pieces;
}

/// Largest error of harmonics 0, 2, 3, 4, 8 ... up to 64, relative to each.
template <class Coefficient, class Exact>
double worst_of_harmonics(const Coefficient& coefficient, const Exact& exact) {
  double worst = 0;
  for (const int n : {0, 2, 3, 4, 8, 16, 32, 63, 64}) {
    const double error = hard_cases::relative(coefficient(n), exact(n));
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

}  // namespace

// Sums of ten products and, for wider arcs, terms that cancel by a factor of fifty: 1e-13.
TEST(HardPressure, HalfAngleToZero) {
  for (const double a : {1e-9, 1e-5, 1e-3, 0.03}) {
    const long double first = cosine_integral(a, 1);
    const auto exact = [&](int n) { return (n == 0 ? 0.5L : 1) * cosine_integral(a, n) / first; };
    std::ostringstream name;
    name << "harmonics 0 to 64 of pressure over half an angle of " << a;
    hard_cases::check({"pressure", name.str(), "they are the rest of terms a^-2 times as large",
                       "the closed form",
                       worst_of_harmonics([&](int n) { return naive_cosine(a, n); }, exact),
                       worst_of_harmonics(
                           [&](int n) {
                             return pattern_coefficient({Shape::cosine, a}, n);
                           },
                           exact),
                       1e-13});
  }
}

// p_n / p_1 = sin(n a) / (n sin a), a = pi - d: (-1)^(n+1) sin(n d) / (n sin d).
TEST(HardPressure, HalfAngleTo180Degrees) {
  const double a = M_PI - 1e-8;
  const long double excess = 5.0165576126683320e-20L;  // of acos(-1) in long double over pi
  const long double d = (std::acos(-1.0L) - a) - excess;
  const auto exact = [&](int n) {
    return n == 0 ? a / (2 * std::sin(d)) : (n % 2 == 0 ? -1 : 1) * std::sin(n * d) / (n * std::sin(d));
  };
  const auto naive = [&](int n) { return (n == 0 ? a / 2 : std::sin(n * a) / n) / std::sin(a); };
  hard_cases::check({"pressure", "harmonics of uniform pressure over 180 degrees less 1e-8",
                     "all sines are the rest of pi", "sin(n a) / (n sin a)", worst_of_harmonics(naive, exact),
                     worst_of_harmonics(
                         [&](int n) {
                           return pattern_coefficient({Shape::uniform, a}, n);
                         },
                         exact),
                     1e-13});
}

// Forces of 1e-200 N beside 1 N, and none, at a seat: the second harmonic carries |F| cos(2 beta), its
// direction from components whose squares are no numbers. Two effects share it.
TEST(HardPressure, ForceThroughZero) {
  Eigen::Array2Xd force(2, 6);
  force << 1, 3e-200, 0, -3e-200, -1, 0,  //
      0, 4e-200, 0, -4e-200, 2, 1e-170;
  pipelines::LoadedBody body;
  body.name = "shaft";
  body.ports = {bodies::port("seat", meshes::Port::Kind::seat, 1, {0, 0.1}, 0.05)};
  pipelines::LoadCollector collector(body, {"one", "two"}, force.cols(), 1);
  collector.force("seat", 0, 0.25 * force);
  collector.force("seat", 1, 0.75 * force);
  collector.pressure("seat");
  const auto loads = collector.finish();
  const Eigen::ArrayXd cosine = bodies::course(loads, "seat.p2c"), sine = bodies::course(loads, "seat.p2s");
  double naive = 0, ours = 0;
  for (Eigen::Index i = 0; i < force.cols(); ++i) {
    const long double x = force(0, i), y = force(1, i), size = std::hypot(x, y);
    const long double c = size == 0 ? 0 : (x * x - y * y) / size, s = size == 0 ? 0 : 2 * x * y / size;
    const double scale = size == 0 ? 1 : double(size);
    ours = std::max({ours, double(std::abs(cosine[i] - c)) / scale, double(std::abs(sine[i] - s)) / scale});
    const double fx = force(0, i), fy = force(1, i), naive_size = std::sqrt(fx * fx + fy * fy);
    const double miss =
        double(std::abs(naive_size * (2 * (fx / naive_size) * (fx / naive_size) - 1) - c)) / scale;
    if (!(miss <= naive)) naive = miss;
  }
  // Five roundings of a product, an angle and a cosine.
  hard_cases::check({"pressure", "no force, and a force through zero",
                     "nothing has no direction; squares of 1e-200 are 0",
                     "|F| (2 (F_x / |F|)^2 - 1), |F| by squares", naive, ours, 2e-15});
}
