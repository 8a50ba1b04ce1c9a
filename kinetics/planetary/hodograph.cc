#include "kinetics/planetary/hodograph.h"

#include <cmath>

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

Harmonics charge_moment(const Machine& machine, const std::vector<std::string>& effects) {
  const PlanetaryMill& mill = machine.mill;
  const double q = machine.charge.first_moment_kg_m, omega = mill.speed_rad_s;
  const double weight_Nm = mill.gravity_m_s2 * q;
  Harmonics M_A;
  if (contains(effects, "charge_transport"))
    M_A.mean_N = q * omega * omega * machine.geometry.carrier_m * std::cos(mill.charge.segment_angle_rad);
  if (contains(effects, "charge_gravity")) {
    M_A.cosine_N = -weight_Nm * std::sin(machine.weight_lag_rad);
    M_A.sine_N = -weight_Nm * std::cos(machine.weight_lag_rad);
  }
  return M_A;
}

void add_masses(const Machine& machine, const std::vector<std::string>& effects, PlanetaryHodograph& h) {
  const PlanetaryMill& mill = machine.mill;
  const auto on = [&](const char* name) { return contains(effects, name); };
  const double omega = mill.speed_rad_s, w = machine.offset_speed_rad_s;
  const double carried_kg =
      on("drum_transport") * mill.drum_mass_kg + on("charge_transport") * machine.charge.mass_kg;
  const double weight_N = mill.gravity_m_s2 * (on("drum_gravity") * mill.drum_mass_kg +
                                               on("charge_gravity") * machine.charge.mass_kg);
  const bool offset_on = on("charge_offset") || on("charge_relative");
  const double offset_N = offset_on ? machine.charge.first_moment_kg_m * w * w : 0;
  const double alpha = mill.charge.segment_angle_rad;
  h.X_A = {carried_kg * omega * omega * machine.geometry.carrier_m + offset_N * std::sin(alpha), 0,
           -weight_N};
  h.Y_A = {offset_N * std::cos(alpha), weight_N, 0};
}

}  // namespace

std::optional<PlanetaryHodograph> ellipse(const Machine& machine, const std::vector<std::string>& effects) {
  PlanetaryHodograph h;
  add_masses(machine, effects, h);
  if (contains(effects, "belt")) {
    const Harmonics M_A = charge_moment(machine, effects);
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
