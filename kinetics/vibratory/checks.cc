#include "kinetics/vibratory/checks.h"

#include <cmath>

#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"
#include "kinetics/vibratory/table.h"

namespace kinetics::vibratory {
namespace {

void require_not_negative(const std::string& parameter, double value, const std::string& meaning) {
  require_finite(parameter, value);
  if (value < 0) refuse(parameter, value, "must not be negative; give " + meaning);
}

/// A mass may be zero only where no effect that is on builds on it: then it was forgotten, or the effect is
/// pointless.
void check_mass(const std::string& parameter, double mass_kg, const std::vector<std::string>& users,
                const std::vector<std::string>& effects) {
  require_not_negative(parameter, mass_kg, "the mass in kg");
  for (const std::string& user : users)
    if (mass_kg == 0 && contains(effects, user))
      refuse(parameter, mass_kg,
             "must be positive for the effect " + user + "; give the mass, or take the effect out");
}

void require_finite(const std::string& parameter, const Eigen::Vector2d& value) {
  kinetics::require_finite(parameter + ".x", value.x());
  kinetics::require_finite(parameter + ".y", value.y());
}

void check_springs(const std::vector<Spring>& springs) {
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const Spring& spring = springs[i];
    const std::string name = "spring_" + std::to_string(i + 1) + ".";
    require_finite(name + "position", spring.position_m);
    if (spring.preload_N) require_finite(name + "preload", *spring.preload_N);
    for (int axis = 0; axis < 2; ++axis) {
      const std::string suffix = axis == 0 ? ".x" : ".y";
      require_not_negative(name + "stiffness" + suffix, spring.stiffness_N_m[axis], "the spring's stiffness");
      require_not_negative(name + "damping" + suffix, spring.damping_N_s_m[axis], "the spring's damping");
    }
  }
}

void check_pitch_inertia(const VibratoryMill& mill) {
  const double least_kg_m2 = mill.structure_mass_kg * mill.structure_centre_m.squaredNorm();
  if (mill.pitch_inertia_kg_m2 <= 0 || mill.pitch_inertia_kg_m2 < least_kg_m2 * (1 - 1e-12))
    refuse("pitch_inertia", mill.pitch_inertia_kg_m2,
           "must be positive and at least structure_mass * |structure_centre|^2 = " + number(least_kg_m2) +
               "; give the inertia of structure and exciter housing about the eccentric's axis, not about a "
               "centre of mass");
}

void check_lag(const VibratoryMill& mill) {
  const auto& [angle_rad, power_W] = mill.charge_lag;
  if (bool(angle_rad) == bool(power_W))
    throw MachineRefused(std::string("charge_lag: loss_angle and grinding_power are ") +
                         (angle_rad ? "both given" : "both missing") +
                         "; the effect needs exactly one of them");
  if (angle_rad) {
    kinetics::require_finite("charge_lag.loss_angle", *angle_rad);
    if (*angle_rad < 0 || *angle_rad > std::acos(0.0))
      refuse("charge_lag.loss_angle", *angle_rad,
             "must lie between 0 and pi/2; a charge trails by a quarter turn at most");
    return;
  }
  require_not_negative("charge_lag.grinding_power", *power_W,
                       "the mean power that grinding takes from the drive");
  const double ecc_m = mill.eccentricity_m, omega = mill.speed_rad_s;
  const double most_W = mill.charge_mass_kg * ecc_m * ecc_m * omega * omega * omega;
  if (*power_W > most_W || most_W == 0)
    refuse("charge_lag.grinding_power", *power_W,
           "the charge cannot take more than m ecc^2 omega_e^3 = " + number(most_W) +
               " W (sin(eta) = P / that would exceed 1); lower the power, or raise the charge's mass, "
               "eccentricity or speed");
}

std::string why_not_here(Convention convention, const std::string& name) {
  if (name == "gravity_shaft" || name == "shaft_inertia")
    return "effect " + name +
           ": needs the shaft's own mass, which comes from its mesh; the pipeline adds it where the "
           "shaft is a body, the load stage alone cannot: take it out of the list given to kinetics";
  if (name == "pitch_guide")
    return "effect pitch_guide: is a couple on the chamber's mesh that the pipeline makes from the quantity "
           "moment_residual; the load stage cannot: take it out of the list given to kinetics";
  const bool published = convention == Convention::published;
  if (contains(effect_names(published ? Convention::consistent : Convention::published), name))
    return "effect " + name + ": is not part of the convention \"" +
           (published ? "published" : "consistent") + "\"; take it out, or choose the convention \"" +
           (published ? "consistent" : "published") + "\"";
  const auto known = effect_names(convention);
  return "effect " + name + ": unknown; did you mean " + nearest(name, known) + "? Known: " + listed(known);
}

}  // namespace

void check_effects(Convention convention, const std::vector<std::string>& effects) {
  const auto known = effect_names(convention);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (!contains(known, effects[i])) throw MachineRefused(why_not_here(convention, effects[i]));
    for (std::size_t j = 0; j < i; ++j)
      if (effects[i] == effects[j])
        throw MachineRefused("effect " + effects[i] + ": named twice; it counts once, take one out");
  }
  require_needs(vibratory_mill_effects(convention), effects);
}

void check_parameters(const VibratoryMill& mill, const std::vector<std::string>& effects) {
  const auto on = [&](const char* name) { return contains(effects, name); };
  require_not_negative("gravity", mill.gravity_m_s2, "the acceleration of gravity, 9.81");
  require_not_negative("eccentricity", mill.eccentricity_m,
                       "the radius of the circle on which the chamber's centre moves");
  require_not_negative(
      "charge_offset", mill.charge_offset_m,
      "the distance of the charge's centre from the chamber's; its side is charge_initial_angle");
  kinetics::require_finite("speed", mill.speed_rad_s);
  if (mill.speed_rad_s <= 0)
    refuse("speed", mill.speed_rad_s,
           "must be positive: the drive turns clockwise by convention; mirror the machine");
  kinetics::require_finite("initial_angle", mill.initial_angle_rad);
  kinetics::require_finite("charge_relative_speed", mill.charge_relative_speed_rad_s);
  kinetics::require_finite("charge_initial_angle", mill.charge_initial_angle_rad);
  kinetics::require_finite("debalance_offset", mill.debalance_offset_m);
  kinetics::require_finite("pitch_inertia", mill.pitch_inertia_kg_m2);
  require_finite("chamber_centre", mill.chamber_centre_m);
  require_finite("structure_centre", mill.structure_centre_m);
  check_mass("structure_mass", mill.structure_mass_kg, {"gravity_structure", "structure_inertia", "pitch"},
             effects);
  check_mass("exciter_mass", mill.exciter_mass_kg, {"gravity_exciter", "exciter_inertia"}, effects);
  check_mass("charge_mass", mill.charge_mass_kg,
             {"gravity_charge", "charge_translation", "charge_centripetal", "charge_coriolis",
              "charge_relative", "charge_follows_pitch"},
             effects);
  check_mass("debalance_mass", mill.debalance_mass_kg, {"gravity_debalance", "debalance_inertia"}, effects);
  check_springs(mill.springs);
  if ((on("springs") || on("spring_damping")) && mill.springs.empty())
    throw MachineRefused("springs: none given, although the effect " +
                         std::string(on("springs") ? "springs" : "spring_damping") +
                         " is on; describe the springs, or take the effect out");
  if (on("pitch")) check_pitch_inertia(mill);
  if (on("charge_lag")) check_lag(mill);
  if (mill.convention == Convention::published && on("springs")) {
    if (mill.springs.size() != 2)
      refuse("number of springs", double(mill.springs.size()),
             "the published formula (59) knows exactly two springs, H and Q; give two, take `springs` out of "
             "the effects, "
             "or choose the convention \"consistent\"");
    if (mill.springs[0].position_m.x() + mill.springs[1].position_m.x() == 0)
      refuse("sum of x of the two springs' position", 0,
             "(59) divides by QE + HE; place the springs otherwise, or choose the convention \"consistent\"");
  }
}

}  // namespace kinetics::vibratory
