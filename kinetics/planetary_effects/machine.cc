#include "kinetics/planetary_effects/machine.h"

#include <algorithm>
#include <cmath>

#include "kinetics/planetary_effects/segment.h"
#include "kinetics/values/constants.h"
#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace {

void require_positive_geometry(const std::string& parameter, double value) {
  require_finite(parameter, value);
  if (value <= 0) refuse(parameter, value, "must be positive");
}

/// @param difference_m  r_O - r_A, given apart because it is exact only before rounding r_O
void add_belt(double difference_m, PlanetaryGeometry& g) {
  constexpr double touching = 1e-12;  // pulleys that touch from within by design are not refused for rounding
  g.belt_sine = difference_m / g.carrier_m;
  const double excess = std::abs(g.belt_sine) - 1;
  if (excess > 0 && excess <= touching) g.belt_sine = std::copysign(1, g.belt_sine);
  g.belt_cosine = std::sqrt(std::max(0.0, (1 - g.belt_sine) * (1 + g.belt_sine)));
  g.wrap_rad = pi - 2 * std::asin(std::min(1.0, std::abs(g.belt_sine)));
}

PlanetaryGeometry from(const PlanetaryRatios& ratios, double drum_radius_m) {
  require_positive_geometry("geometry.k", ratios.k);
  if (ratios.k >= 1) refuse("geometry.k", ratios.k, "must be below 1: k = r_A / (l_OA + r_A)");
  require_positive_geometry("geometry.b", ratios.b);
  require_positive_geometry("geometry.c", ratios.c);
  require_positive_geometry("drum_radius", drum_radius_m);
  const double d_over_rA = (1 - ratios.c) / ratios.c;
  PlanetaryGeometry g;
  g.drum_pulley_m = drum_radius_m / ratios.b;                   // (7)
  g.carrier_m = g.drum_pulley_m * ((1 - ratios.k) / ratios.k);  // (6)
  g.central_pulley_m = g.drum_pulley_m / ratios.c;              // (8)
  g.drum_speed_ratio = -d_over_rA;                              // (4) with its sign
  g.relative_speed_ratio = -1 / ratios.c;
  add_belt(d_over_rA * g.drum_pulley_m, g);
  return g;
}

PlanetaryGeometry from(const PlanetaryLengths& lengths) {
  require_positive_geometry("geometry.carrier_length", lengths.carrier_m);
  require_positive_geometry("geometry.central_pulley_radius", lengths.central_pulley_m);
  require_positive_geometry("geometry.drum_pulley_radius", lengths.drum_pulley_m);
  const double difference_m = lengths.central_pulley_m - lengths.drum_pulley_m;
  PlanetaryGeometry g;
  g.carrier_m = lengths.carrier_m;
  g.central_pulley_m = lengths.central_pulley_m;
  g.drum_pulley_m = lengths.drum_pulley_m;
  g.drum_speed_ratio = -difference_m / lengths.drum_pulley_m;
  g.relative_speed_ratio = -lengths.central_pulley_m / lengths.drum_pulley_m;
  add_belt(difference_m, g);
  return g;
}

void require_within(const std::string& parameter, double value, double most, const std::string& meaning) {
  require_finite(parameter, value);
  if (value < 0 || value > most)
    refuse(parameter, value, "must lie between 0 and " + number(most) + "; give " + meaning);
}

planetary::Segment segment(const PlanetaryCharge& charge) {
  if (bool(charge.filling) + bool(charge.void_fraction) + bool(charge.half_angle_rad) != 1)
    throw MachineRefused(
        std::string("charge: of filling, void_fraction and half_angle ") +
        (charge.filling || charge.void_fraction || charge.half_angle_rad ? "more than one is" : "none is") +
        " given; give exactly one of them");
  if (charge.filling) {
    require_within("charge.filling", *charge.filling, 1, "the charge's share of the drum's cross-section");
    return planetary::segment_of_filling(*charge.filling);
  }
  if (charge.void_fraction) {
    require_within("charge.void_fraction", *charge.void_fraction, 1,
                   "the empty share of the drum's cross-section");
    return planetary::segment_of_void(*charge.void_fraction);
  }
  require_within("charge.half_angle", *charge.half_angle_rad, pi,
                 "half the angle that the charge's surface spans, in rad");
  return planetary::segment_of_half_angle(*charge.half_angle_rad);
}

}  // namespace

PlanetaryGeometry planetary_geometry(const PlanetaryMill& mill) {
  if (const auto* ratios = std::get_if<PlanetaryRatios>(&mill.geometry))
    return from(*ratios, mill.drum_radius_m);
  return from(std::get<PlanetaryLengths>(mill.geometry));
}

PlanetaryChargeBody planetary_charge_body(const PlanetaryMill& mill) {
  const planetary::Segment s = segment(mill.charge);
  const double r_m = mill.drum_radius_m, rho_L = mill.charge.bulk_density_kg_m3 * mill.drum_length_m;
  const double chord_m = r_m * s.sine;  // half of it
  return {s.filling, s.half_angle_rad, rho_L * pi * r_m * r_m * s.filling,
          rho_L * (2.0 / 3) * chord_m * chord_m * chord_m, r_m * planetary::centroid_distance(s)};
}

namespace planetary {

Machine make_machine(const PlanetaryMill& mill) {
  const bool consistent = mill.convention == PlanetaryConvention::consistent;
  const bool as_published = mill.convention == PlanetaryConvention::as_published;
  Machine machine;
  machine.mill = mill;
  machine.geometry = planetary_geometry(mill);
  if (mill.charge.filling || mill.charge.void_fraction || mill.charge.half_angle_rad)
    machine.charge = planetary_charge_body(mill);
  const PlanetaryGeometry& g = machine.geometry;
  machine.offset_speed_rad_s = mill.speed_rad_s * (consistent ? 1 : g.drum_speed_ratio);
  machine.weight_lag_rad = as_published ? 0 : mill.charge.segment_angle_rad;
  machine.axle_belt_sine = consistent ? g.belt_sine : std::abs(g.belt_sine) * (as_published ? -1 : 1);
  return machine;
}

}  // namespace planetary
}  // namespace kinetics
