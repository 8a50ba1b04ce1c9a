#include "kinetics/planetary/checks.h"

#include <algorithm>

#include "kinetics/planetary/table.h"
#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics::planetary {
namespace {

void require_not_negative(const std::string& parameter, double value, const std::string& meaning) {
  require_finite(parameter, value);
  if (value < 0) refuse(parameter, value, "must not be negative; give " + meaning);
}

void require_positive(const std::string& parameter, double value, const std::string& meaning) {
  require_finite(parameter, value);
  if (value <= 0) refuse(parameter, value, "must be positive; give " + meaning);
}

/// What an effect that is on builds on must be there: else it was forgotten, or the effect is pointless.
void check_used(const std::string& parameter, double value, const std::vector<std::string>& users,
                const std::vector<std::string>& effects, const std::string& meaning) {
  require_not_negative(parameter, value, meaning);
  for (const std::string& user : users)
    if (value == 0 && contains(effects, user))
      refuse(parameter, value,
             "must be positive for the effect " + user + "; give " + meaning + ", or take the effect out");
}

std::vector<std::string> charge_effects() {
  return {"charge_transport", "charge_relative", "charge_offset", "charge_gravity"};
}

void check_charge(const PlanetaryMill& mill, const std::vector<std::string>& effects) {
  const auto users = charge_effects();
  check_used("drum_length", mill.drum_length_m, users, effects, "the inner length of the drum");
  check_used("charge.bulk_density", mill.charge.bulk_density_kg_m3, users, effects,
             "the bulk density of the charge");
  require_finite("charge.segment_angle", mill.charge.segment_angle_rad);
  const bool in_use =
      std::any_of(users.begin(), users.end(), [&](const auto& user) { return contains(effects, user); });
  if (in_use || mill.charge.filling || mill.charge.void_fraction || mill.charge.half_angle_rad)
    planetary_charge_body(mill);
}

void check_belt(const PlanetaryBelt& belt) {
  if (const auto* ratio = std::get_if<RatioBelt>(&belt)) {
    require_finite("belt.ratio", ratio->ratio);
    if (ratio->ratio <= 1)
      refuse("belt.ratio", ratio->ratio, "must be above 1: the tight strand pulls more than the slack one");
  } else if (const auto* eytelwein = std::get_if<EytelweinBelt>(&belt)) {
    require_positive("belt.friction", eytelwein->friction, "the friction of belt on pulley");
  } else {
    const auto& pretensioned = std::get<PretensionedBelt>(belt);
    require_not_negative("belt.pretension", pretensioned.pretension_N, "the pretension of one strand");
    require_positive("belt.friction", pretensioned.friction, "the friction of belt on pulley");
  }
}

std::string why_not_here(PlanetaryConvention convention, const std::string& name) {
  if (name == "drum_spin")
    return "effect drum_spin: loads the drum's own mesh and has no resultant; the pipeline adds it where the "
           "drum is a body: take it out of the list given to kinetics";
  if (name == "drive_couple")
    return "effect drive_couple: is there by itself when the effect belt is off (resultant \"pulley\"): take "
           "it out of the list given to kinetics";
  for (const EffectRow& row : effect_table())
    if (name == row.info.name || name == row.consistent_name)
      return "effect " + name + ": is called " + row.name(convention) + " under the convention \"" +
             name_of(convention) + "\"; rename it";
  const auto known = effect_names(convention);
  return "effect " + name + ": unknown; did you mean " + nearest(name, known) + "? Known: " + listed(known);
}

}  // namespace

std::string name_of(PlanetaryConvention convention) {
  if (convention == PlanetaryConvention::as_published) return "as_published";
  return convention == PlanetaryConvention::as_plotted ? "as_plotted" : "consistent";
}

void check_effects(PlanetaryConvention convention, const std::vector<std::string>& effects) {
  const auto known = effect_names(convention);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (!contains(known, effects[i])) throw MachineRefused(why_not_here(convention, effects[i]));
    if (std::find(effects.begin(), effects.begin() + std::ptrdiff_t(i), effects[i]) !=
        effects.begin() + std::ptrdiff_t(i))
      throw MachineRefused("effect " + effects[i] + ": named twice; it counts once, take one out");
  }
  require_needs(planetary_mill_effects(convention), effects);
}

void check_parameters(const PlanetaryMill& mill, const std::vector<std::string>& effects) {
  require_not_negative("gravity", mill.gravity_m_s2, "the acceleration of gravity, 9.81");
  require_positive("speed", mill.speed_rad_s,
                   "the carrier's speed; it turns counter-clockwise by convention: mirror the machine");
  require_finite("initial_angle", mill.initial_angle_rad);
  require_finite("initial_drum_angle", mill.initial_drum_angle_rad);
  require_positive("drum_radius", mill.drum_radius_m, "the inner radius of the drum");
  check_used("drum_mass", mill.drum_mass_kg, {"drum_transport", "drum_gravity"}, effects,
             "the mass of shell, covers and pulley");
  planetary_geometry(mill);
  check_charge(mill, effects);
  check_belt(mill.belt);
  if (mill.belt_beyond_geometry && mill.convention == PlanetaryConvention::consistent)
    refuse("belt.beyond_geometry", 1,
           "is for the two conventions of the paper; set it to false, or choose as_plotted or as_published");
}

}  // namespace kinetics::planetary
