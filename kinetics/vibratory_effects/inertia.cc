#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {
namespace {

/// -mass s'': what a mass feels that the eccentric carries round.
Effect carried_round(const VibratoryMill& mill, double mass_kg, Place place) {
  return [=](const Instants& at) {
    return std::vector<PlacedForce>{{place, 0, -mass_kg * translation_acceleration(mill, at), {}}};
  };
}

}  // namespace

Effect structure_inertia(const VibratoryMill& mill) {
  return carried_round(mill, mill.structure_mass_kg, Place::structure_centre);
}

Effect exciter_inertia(const VibratoryMill& mill) {
  return carried_round(mill, mill.exciter_mass_kg, Place::pivot);
}

Effect debalance_inertia(const VibratoryMill& mill) {
  const double first_moment_kg_m = mill.debalance_mass_kg * mill.debalance_offset_m;
  return [=](const Instants& at) {
    const Eigen::Array2Xd force_N = composed(first_moment_kg_m * at.speed_rad_s.square(),  // (33)
                                             -first_moment_kg_m * at.acceleration_rad_s2, at.along_phi);
    return std::vector<PlacedForce>{{Place::debalance, 0, force_N, {}}};
  };
}

}  // namespace kinetics::vibratory
