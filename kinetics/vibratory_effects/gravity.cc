#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {
namespace {

/// (0, -mass g) at a place, at all instants alike.
Effect weight(double mass_kg, double gravity_m_s2, Place place) {
  return [=](const Instants& at) {
    const Eigen::Vector2d weight_N(0, -mass_kg * gravity_m_s2);
    return std::vector<PlacedForce>{{place, 0, constant(weight_N, at.size()), {}}};
  };
}

}  // namespace

Effect gravity_structure(const VibratoryMill& mill) {
  return weight(mill.structure_mass_kg, mill.gravity_m_s2, Place::structure_centre);
}

Effect gravity_exciter(const VibratoryMill& mill) {
  return weight(mill.exciter_mass_kg, mill.gravity_m_s2, Place::pivot);
}

Effect gravity_charge(const VibratoryMill& mill) {
  return weight(mill.charge_mass_kg, mill.gravity_m_s2, Place::charge_centre);
}

Effect gravity_debalance(const VibratoryMill& mill) {
  return weight(mill.debalance_mass_kg, mill.gravity_m_s2, Place::debalance);
}

}  // namespace kinetics::vibratory
