#include "kinetics/planetary/hodograph.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinetics/planetary_effects/belt.h"
#include "kinetics/planetary_effects/effect.h"
#include "kinetics/values/constants.h"

namespace kinetics {

double PlanetaryHodograph::Component::amplitude_N() const {
  return std::hypot(cosine_N, sine_N);
}

namespace planetary {
namespace {

/// mean + cosine cos(phi) + sine sin(phi), in N or N m.
using Harmonics = PlanetaryHodograph::Component;

void add(Harmonics& to, double factor, const Harmonics& h) {
  to.mean_N += factor * h.mean_N;
  to.cosine_N += factor * h.cosine_N;
  to.sine_N += factor * h.sine_N;
}

double at(const Harmonics& h, double phi) {
  return h.mean_N + h.cosine_N * std::cos(phi) + h.sine_N * std::sin(phi);
}

double slope(const Harmonics& h, double phi) {
  return h.sine_N * std::cos(phi) - h.cosine_N * std::sin(phi);
}

struct Extreme {
  double phi_rad = 0, R_N = 0;
};

/// Largest (sign = 1) or smallest (-1) R over a turn. R^2 has two harmonics, hence at most two maxima: every
/// one of a fine sampling is taken to where the slope vanishes, by halving.
Extreme extreme(const Harmonics& X, const Harmonics& Y, double sign) {
  constexpr int n_samples = 720;
  const auto R = [&](double phi) { return std::hypot(at(X, phi), at(Y, phi)); };
  const auto rise = [&](double phi) {
    return sign * (at(X, phi) * slope(X, phi) + at(Y, phi) * slope(Y, phi));
  };
  const double step = 2 * pi / n_samples;
  Extreme best{0, R(0)};
  for (int i = 0; i < n_samples; ++i) {
    double low = (i - 1) * step, high = (i + 1) * step;
    if (sign * R(i * step) < sign * R(low) || sign * R(i * step) < sign * R(high)) continue;
    while (true) {
      const double middle = (low + high) / 2;
      if (middle <= low || middle >= high) break;
      (rise(middle) > 0 ? low : high) = middle;
    }
    if (sign * R(low) > sign * best.R_N) best = {low < 0 ? low + 2 * pi : low, R(low)};
  }
  return best;
}

/// The harmonics of values at phi = 0, 90, 180 and 270 degrees; rounding of what cancels is none. No effect
/// but the belt has a harmonic above the first: the unit test PlanetaryHodograph holds every one of the table
/// to it.
Harmonics harmonics(const Eigen::Array4d& value) {
  const double least = 4 * std::numeric_limits<double>::epsilon() * value.abs().maxCoeff();
  const auto or_nothing = [&](double x) { return std::abs(x) > least ? x : 0; };
  return {or_nothing(value.mean()), or_nothing((value[0] - value[2]) / 2),
          or_nothing((value[1] - value[3]) / 2)};
}

/// What the effects but the belt put on the axle, and their moment about A.
struct Unbalanced {
  Harmonics X_A, Y_A, M_A;
};

Unbalanced unbalanced(const Machine& machine, std::vector<std::string> effects) {
  effects.erase(std::remove(effects.begin(), effects.end(), "belt"), effects.end());
  const Instants quarters{Eigen::Array4d(0, pi / 2, pi, 3 * pi / 2), Eigen::Array4d::Zero()};
  Unbalanced sum;
  for (const auto& effect : make_effects(machine, effects)) {
    const EffectLoad load = effect.evaluate(quarters);
    add(sum.X_A, 1, harmonics(load.on_axle_N.row(0).transpose()));
    add(sum.Y_A, -1, harmonics(load.on_axle_N.row(1).transpose()));
    add(sum.M_A, 1, harmonics(load.moment_Nm));
  }
  return sum;
}

}  // namespace

std::optional<PlanetaryHodograph> ellipse(const Machine& machine, const std::vector<std::string>& effects) {
  PlanetaryHodograph h;
  const auto [X_A, Y_A, M_A] = unbalanced(machine, effects);
  h.X_A = X_A;
  h.Y_A = Y_A;
  if (contains(effects, "belt")) {
    const TensionSum sum = tension_sum(machine);
    if (sum.factor != 0 && !sum.follows_sign && std::abs(M_A.mean_N) < M_A.amplitude_N()) return std::nullopt;
    const double sign = sum.follows_sign || M_A.mean_N >= 0 ? 1 : -1;
    const double r_A_m = machine.geometry.drum_pulley_m, cosine = machine.geometry.belt_cosine;
    add(h.X_A, -sign * sum.factor * cosine / r_A_m, M_A);
    h.X_A.mean_N -= cosine * sum.constant_N;
    add(h.Y_A, machine.axle_belt_sine / r_A_m, M_A);
  }
  h.R_mean_N = std::hypot(h.X_A.mean_N, h.Y_A.mean_N);
  const double pc = h.X_A.mean_N * h.X_A.cosine_N + h.Y_A.mean_N * h.Y_A.cosine_N;
  const double ps = h.X_A.mean_N * h.X_A.sine_N + h.Y_A.mean_N * h.Y_A.sine_N;
  h.R_amplitude_N = h.R_mean_N > 0 ? std::hypot(pc, ps) / h.R_mean_N : 0;
  h.R_phase_rad = std::atan2(ps, pc);
  const Extreme most = extreme(h.X_A, h.Y_A, 1), least = extreme(h.X_A, h.Y_A, -1);
  h.R_max_N = most.R_N, h.phi_of_R_max_rad = most.phi_rad;
  h.R_min_N = least.R_N, h.phi_of_R_min_rad = least.phi_rad;
  return h;
}

}  // namespace planetary
}  // namespace kinetics
