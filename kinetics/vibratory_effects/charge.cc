/// The grinding charge, a point mass m at O = C + r e(chi). Its four inertia terms add up to -m d2O/dt2 of
/// the prescribed motion; charge_lag adds what a charge that trails the chamber brings.
#include <cmath>

#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {
namespace {

std::vector<PlacedForce> on_charge(Eigen::Array2Xd force_N) {
  return {{Place::charge_centre, 0, std::move(force_N), {}}};
}

double first_moment_kg_m(const VibratoryMill& mill) {
  return mill.charge_mass_kg * mill.charge_offset_m;
}

}  // namespace

double loss_angle_rad(const VibratoryMill& mill) {
  if (mill.charge_lag.loss_angle_rad) return *mill.charge_lag.loss_angle_rad;
  const double ecc = mill.eccentricity_m, omega = mill.speed_rad_s;
  return std::asin(*mill.charge_lag.grinding_power_W /
                   (mill.charge_mass_kg * ecc * ecc * omega * omega * omega));
}

Effect charge_translation(const VibratoryMill& mill) {
  return [mill](const Instants& at) {
    return on_charge(-mill.charge_mass_kg * translation_acceleration(mill, at));  // steady: (35)
  };
}

Effect charge_centripetal(const VibratoryMill& mill) {
  const double mr = first_moment_kg_m(mill);
  return [mr](const Instants& at) {
    return on_charge(composed(mr * at.speed_rad_s.square(),  // the term that (15) drops
                              -mr * at.acceleration_rad_s2, at.along_chi));
  };
}

Effect charge_coriolis(const VibratoryMill& mill) {
  const double mr = first_moment_kg_m(mill);
  return [mr](const Instants& at) {
    return on_charge(scaled(2 * mr * at.speed_rad_s * at.relative_speed_rad_s, at.along_chi));  // (39)
  };
}

Effect charge_relative(const VibratoryMill& mill) {
  const double mr = first_moment_kg_m(mill);
  return [mr](const Instants& at) {
    return on_charge(composed(mr * at.relative_speed_rad_s.square(),  // (37)
                              -mr * at.relative_acceleration_rad_s2, at.along_chi));
  };
}

Effect charge_lag(const VibratoryMill& mill) {
  const double eta_rad = loss_angle_rad(mill);
  return [mill, eta_rad](const Instants& at) {
    return on_charge(-mill.charge_mass_kg *
                     (translation_acceleration(mill, at, -eta_rad) - translation_acceleration(mill, at)));
  };
}

}  // namespace kinetics::vibratory
