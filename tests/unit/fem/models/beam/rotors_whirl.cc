// Whirl frequencies and critical speeds of rotors against closed forms, to 0.1 %.
#include "fem/models/beam/rotor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include "fem/base/values/constants.h"
#include "fem/models/beam/beam_section.h"

namespace {

using fem::pi;
constexpr fem::Material steel_of_rotors{206e9, 0.3, 7850};
/// So light that it is a spring for the discs on it.
constexpr fem::Material light_steel{206e9, 0.3, 7850e-6};
constexpr double told = 1e-3;

/// A plain shaft of diameter d from 0 to L.
fem::Rotor plain_rotor(double d, double L, const fem::Material& material = steel_of_rotors) {
  return {{{0, L, d / 2}}, material, {}, {{0}, {L}}};
}

struct Section {
  double area, inertia, bending, shear;  // A, I, E I, kappa G A
  explicit Section(double d)
      : area(pi * d * d / 4),
        inertia(pi * std::pow(d, 4) / 64),
        bending(206e9 * inertia),
        shear(206e9 / 2.6 * area * 6 * 1.3 / (7 + 6 * 0.3)) {}  // Cowper (1966), full circle
};

/// Roots of f between two places, ascending, each between neighbours of `n` steps.
std::vector<double> roots(const std::function<double(double)>& f, double from, double to, int n) {
  std::vector<double> found;
  for (int i = 0; i < n; ++i) {
    double a = from + (to - from) * i / n, b = from + (to - from) * (i + 1) / n;
    if ((f(a) < 0) == (f(b) < 0)) continue;
    for (int step = 0; step < 80; ++step) {
      const double middle = (a + b) / 2;
      ((f(middle) < 0) == (f(a) < 0) ? a : b) = middle;
    }
    found.push_back((a + b) / 2);
  }
  return found;
}

/// Deflection of a simply supported beam by 1 N in its middle: L^3 / 48 EI, and L / 4 kappa G A by shear.
double middle_flexibility(const Section& s, double L) {
  return L * L * L / (48 * s.bending) + L / (4 * s.shear);
}

// Jeffcott: w = sqrt(k / m). In the middle the disc does not tilt.
// Turns red: bearings in series forgotten, a stiffness counted at one bearing only, shear left out (0.8 %).
TEST(Rotors, OfJeffcottOnRigidAndElasticBearings) {
  const double d = 0.05, L = 0.6, mass = 40;
  for (const double bearing : {std::numeric_limits<double>::infinity(), 5e7, 1e6}) {
    auto rotor = plain_rotor(d, L, light_steel);
    rotor.discs = {{L / 2, mass, 0.5, 0.3}};
    for (auto& b : rotor.bearings) b.stiffness_N_m = bearing;
    const double expected = std::sqrt(1 / (mass * (middle_flexibility(Section(d), L) + 1 / (2 * bearing))));
    EXPECT_NEAR(fem::critical_speeds_rad_s(rotor, 1).front(), expected, 1e-5 * expected) << bearing;
    const auto whirl = fem::whirl_frequencies(rotor, 3 * expected);  // none of the speed: it does not tilt
    EXPECT_NEAR(whirl.forward_rad_s.front(), expected, 1e-5 * expected) << bearing;
  }
}

/// Determinant of a simply supported Timoshenko shaft in n half waves, W = a sin k z and tilt b cos k z:
///   (rho A w^2 - kGA k^2) a + kGA k b = 0,  kGA k a + (rho I (w^2 - 2 spin w) - E I k^2 - kGA) b = 0,
/// scaled. Timoshenko (1921) for spin = 0.
double determinant_of_waves(const Section& s, double L, int n, double w, double spin) {
  const double k = n * pi / L, rho = steel_of_rotors.density_kg_m3, kGA = s.shear;
  const double first = rho * s.area * w * w - kGA * k * k;
  const double second = rho * s.inertia * (w * w - 2 * spin * w) - s.bending * k * k - kGA;
  return (first * second - kGA * kGA * k * k) / (kGA * kGA * k * k);
}

// Turns red: rotary inertia left out (2 % of the second mode), shear left out, the polar inertia taken for
// the diametral one, the wrong sign of the gyroscopic term.
TEST(Rotors, OfAUniformShaftAreTimoshenkos) {
  const double d = 0.1, L = 0.8;
  const Section s(d);
  const auto rotor = plain_rotor(d, L);
  const auto first_root = [&](int n, const std::function<double(double)>& spin) {
    return roots([&](double w) { return determinant_of_waves(s, L, n, w, spin(w)); }, 1, 40e3, 4000).front();
  };
  for (const double spin : {0.0, 2000.0}) {
    const auto whirl = fem::whirl_frequencies(rotor, spin);
    for (int n = 1; n <= 3; ++n) {
      const double forward = first_root(n, [&](double) { return spin; }),
                   backward = first_root(n, [&](double) { return -spin; });
      EXPECT_NEAR(whirl.forward_rad_s[std::size_t(n - 1)], forward, told * forward) << n << " at " << spin;
      EXPECT_NEAR(whirl.backward_rad_s[std::size_t(n - 1)], backward, told * backward) << n << " at " << spin;
    }
  }
  for (const double order : {1.0, -1.0, 2.0, -3.0})
    for (int n = 1; n <= 3; ++n) {
      const double w = first_root(n, [&](double frequency) { return frequency / order; });
      EXPECT_NEAR(fem::critical_speeds_rad_s(rotor, order)[std::size_t(n - 1)], w / std::abs(order),
                  told * w / std::abs(order))
          << n << ", order " << order;
    }
}

// A slender bar on springs at both ends, of Bernoulli and Euler: about its middle
//   even: A cos b z + B cosh b z, odd: A sin b z + B sinh b z; W'' = 0 and E I W''' = k W at the ends.
// Turns red: springs at the wrong end or counted twice; a rigid bearing where an elastic one is meant.
TEST(Rotors, OfAUniformShaftOnSpringsAreBernoullis) {
  const double d = 0.01, L = 2, stiffness = 2000, half = L / 2;  // shear and rotary inertia: 1e-4 of it
  const Section s(d);
  const double mass_per_m = steel_of_rotors.density_kg_m3 * s.area;
  const auto ends = [&](bool even, double b) {
    const double x = b * half, c = std::cos(x), ch = std::cosh(x), si = std::sin(x), sh = std::sinh(x);
    const double A = 1, B = even ? c / ch : si / sh;  // W'' = 0
    const double third = even ? b * b * b * (A * si + B * sh) : b * b * b * (-A * c + B * ch);
    const double value = even ? A * c + B * ch : A * si + B * sh;
    return s.bending * third - stiffness * value;
  };
  auto rotor = plain_rotor(d, L);
  for (auto& b : rotor.bearings) b.stiffness_N_m = stiffness;
  const auto found = fem::whirl_frequencies(rotor, 0).forward_rad_s;
  std::vector<double> expected;
  for (const bool even : {true, false})
    for (const double b : roots([&](double at) { return ends(even, at); }, 0.05, 6, 2000))
      expected.push_back(b * b * std::sqrt(s.bending / mass_per_m));
  std::sort(expected.begin(), expected.end());
  ASSERT_GE(expected.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], told * expected[i]) << i;
}

// An overhung disc on a light shaft, by the flexibilities of a beam with an overhang c beyond the span a:
//   det(F^-1 - w^2 diag(m, J_d) + w W diag(0, J_p)) = 0, four w at each speed.
// Turns red: forward and backward exchanged, J_p and J_d exchanged, half the gyroscopic moment.
TEST(Rotors, OverhungDiscsAreGyroscopic) {
  const double d = 0.03, a = 0.3, c = 0.2, mass = 12, polar = 0.25, diametral = 0.13;
  const Section s(d);
  const double ww = c * c * (a + c) / (3 * s.bending) + (c + c * c / a) / s.shear,
               wt = c * (2 * a + 3 * c) / (6 * s.bending) + c / a / s.shear,
               tt = (a / 3 + c) / s.bending + 1 / (a * s.shear), det = ww * tt - wt * wt;
  const auto determinant = [&](double w, double spin) {
    return ((tt / det - w * w * mass) * (ww / det - w * w * diametral + w * spin * polar) -
            wt * wt / (det * det)) *
           det;
  };
  auto rotor = plain_rotor(d, a + c, light_steel);
  rotor.bearings = {{0}, {a}};
  rotor.discs = {{a + c, mass, polar, diametral}};
  for (const double spin : {0.0, 50.0, 300.0, 1500.0}) {
    const auto whirl = fem::whirl_frequencies(rotor, spin);
    const auto expected = roots([&](double w) { return determinant(w, spin); }, -4000, 4000, 100001);
    ASSERT_EQ(expected.size(), 4u) << spin;
    EXPECT_NEAR(whirl.backward_rad_s[1], -expected[0], told * -expected[0]) << spin;
    EXPECT_NEAR(whirl.backward_rad_s[0], -expected[1], told * -expected[1]) << spin;
    EXPECT_NEAR(whirl.forward_rad_s[0], expected[2], told * expected[2]) << spin;
    EXPECT_NEAR(whirl.forward_rad_s[1], expected[3], told * expected[3]) << spin;
  }
  // J_p > J_d: imbalance meets the first forward whirl alone, its opposite two backward ones.
  for (const double order : {1.0, -1.0}) {
    const auto met = roots([&](double w) { return determinant(w, w / order); }, 1, 4000, 20001);
    const auto found = fem::critical_speeds_rad_s(rotor, order);
    ASSERT_EQ(met.size(), order > 0 ? 1u : 2u);
    for (std::size_t i = 0; i < met.size(); ++i) EXPECT_NEAR(found[i], met[i], told * met[i]) << order << i;
  }
}

// Turns red: a rule of two points for the integrals, a lumped mass, one shear angle for a whole element.
TEST(Rotors, ConvergeWithTheFourthPowerAtLeast) {
  const double L = 0.8;
  for (const double d : {0.1, 0.002}) {
    auto rotor = plain_rotor(d, L);
    const auto third = [&](int n) {
      rotor.n_elements = n;
      return fem::critical_speeds_rad_s(rotor, 1)[2];
    };
    const double exact =
        roots([&](double w) { return determinant_of_waves(Section(d), L, 3, w, w); }, 1, 40e3, 40000).front();
    const double order = std::log2((third(3) - exact) / (third(6) - exact));
    EXPECT_LT(third(10) / exact - 1, 6e-4) << d;  // as fem/models/README.md has it
    EXPECT_GT(order, 3.5) << d;
    EXPECT_GT(third(6), exact) << d;
  }
}

// Turns red: elements that ignore where segments end, or a disc or bearing between their ends.
TEST(Rotors, SegmentsAndPlacesMayLieAnywhere) {
  auto rotor = plain_rotor(0.05, 0.7);
  rotor.discs = {{0.237, 5, 0.02, 0.01}};
  rotor.bearings[1].z_m = 0.61;
  const auto whole = fem::whirl_frequencies(rotor, 400).forward_rad_s;
  rotor.segments = {{0, 0.0713, 0.025}, {0.0713, 0.415, 0.025}, {0.415, 0.7, 0.025}};
  const auto parts = fem::whirl_frequencies(rotor, 400).forward_rad_s;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(parts[i], whole[i], 1e-4 * whole[i]) << i;
}

// Turns red: a rotor that floats is solved, and rounding takes the place of its rigid motions.
TEST(Rotors, ThatCannotWhirlAreRefused) {
  const auto sound = plain_rotor(0.05, 0.7);
  const auto refused = [&](const std::function<void(fem::Rotor&)>& edit) {
    auto rotor = sound;
    edit(rotor);
    EXPECT_THROW(fem::whirl_frequencies(rotor, 0), std::invalid_argument);
    EXPECT_THROW(fem::critical_speeds_rad_s(rotor, 1), std::invalid_argument);
  };
  refused([](auto& r) { r.segments.clear(); });
  refused([](auto& r) { r.segments.push_back({0.8, 0.9, 0.02}); });
  refused([](auto& r) { r.bearings.pop_back(); });
  refused([](auto& r) { r.bearings[1].z_m = 0; });
  refused([](auto& r) { r.bearings[1].z_m = 0.71; });
  refused([](auto& r) { r.bearings[1].stiffness_N_m = -1; });
  refused([](auto& r) { r.discs = {{0.3, 0, 0, 0}}; });
  EXPECT_THROW(fem::critical_speeds_rad_s(sound, 0), std::invalid_argument);
}

}  // namespace
