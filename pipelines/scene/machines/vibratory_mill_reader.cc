#include "pipelines/scene/machines/vibratory_mill_reader.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/scene/values/effect_names.h"

namespace pipelines {
namespace {

constexpr double most_speed_rad_s = 1e4;
constexpr double most_mass_kg = 1e6;
constexpr double longest_machine_m = 100;
constexpr double most_bulk_density_kg_m3 = 1e4;  // balls of tungsten carbide

Eigen::Vector2d pair(SceneTable& table, const std::string& name, const std::string& unit,
                     const Range& range) {
  const std::vector<double> values = table.quantities(name, unit, range, 2);
  return {values[0], values[1]};
}

/// A mass may be 0 only where no effect that is on builds on it.
double read_mass(SceneTable& table, const std::vector<std::string>& users,
                 const std::vector<std::string>& effects) {
  const double mass_kg = table.quantity("mass", "kg", not_negative(most_mass_kg));
  for (const std::string& user : users) {
    if (mass_kg != 0 || !contains(effects, user)) continue;
    table.refuse("mass", "must be positive for the effect \"" + user +
                             "\"; give the mass, or remove the effects that need it");
    break;
  }
  return mass_kg;
}

/// Which one of two keys is to be read: exactly one is there; the other is not touched.
/// @return true if the first is to be read, false for the second, empty (reported) for none or both
std::optional<bool> one_of(SceneTable& table, const std::string& first, const std::string& second,
                           const std::string& meanings) {
  table.know(first);
  table.know(second);
  if (table.has(first) && table.has(second))
    table.refuse(second, "says the same as " + first + "; keep one of the two");
  else if (!table.has(first) && !table.has(second))
    table.refuse_missing(first, "is missing, and so is " + second + "; add one of them: " + meanings);
  else
    return table.has(first);
  return std::nullopt;
}

void read_drive(SceneTable drive, kinetics::VibratoryMill& mill) {
  mill.eccentricity_m = drive.quantity("eccentricity", "m", not_negative(0.1));
  mill.speed_rad_s = drive.quantity("speed", "rad/s", positive(most_speed_rad_s));
  mill.initial_angle_rad =
      drive.quantity_or("initial_angle", "rad", any_angle(), 0, "the cycle begins at phi = 0");
  drive.finish();
}

/// Reads the charge's lag, after the drive: the largest power that a lag can carry depends on it.
void read_charge_lag(SceneTable& charge, bool is_on, kinetics::VibratoryMill& mill) {
  const std::string meanings =
      "grinding_power, which the charge takes up on average, or loss_angle, by which its translation lags "
      "the "
      "chamber's";
  if (!charge.has("lag")) {
    charge.know("lag");
    if (is_on) charge.refuse_missing("lag", "is missing; the effect \"charge_lag\" needs " + meanings);
    return;
  }
  SceneTable lag = charge.table("lag");
  if (const auto is_power = one_of(lag, "grinding_power", "loss_angle", meanings); !is_power) {
  } else if (*is_power) {
    const double power_W = lag.quantity("grinding_power", "W", not_negative(1e9));
    const double most_W =
        mill.charge_mass_kg * std::pow(mill.eccentricity_m, 2) * std::pow(mill.speed_rad_s, 3);
    if (is_on && power_W > most_W)
      lag.refuse("grinding_power", "sin(eta) = P / (m ecc^2 omega^3) would be " + shown(power_W / most_W, 3) +
                                       ", above 1: this charge takes up at most " +
                                       shown(std::floor(most_W)) +
                                       " W; state less, or raise mass, eccentricity or speed");
    mill.charge_lag.grinding_power_W = power_W;
  } else {
    mill.charge_lag.loss_angle_rad = lag.quantity("loss_angle", "rad", between(0, pi / 2));
  }
  lag.finish();
}

void read_charge(SceneTable charge, const std::vector<std::string>& effects, kinetics::VibratoryMill& mill) {
  mill.charge_mass_kg = read_mass(charge,
                                  {"gravity_charge", "charge_translation", "charge_centripetal",
                                   "charge_coriolis", "charge_relative", "charge_follows_pitch"},
                                  effects);
  mill.charge_offset_m = charge.quantity("offset", "m", not_negative(longest_machine_m));
  const auto is_ratio =
      one_of(charge, "turn_ratio", "relative_speed",
             "turn_ratio, turns of the charge per turn of the drive as seen from outside, or relative_speed "
             "against the drive");
  if (is_ratio)
    mill.charge_relative_speed_rad_s =
        *is_ratio ? (charge.ratio("turn_ratio") - 1) * mill.speed_rad_s
                  : charge.quantity("relative_speed", "rad/s", between(-most_speed_rad_s, most_speed_rad_s));
  else
    mill.charge_relative_speed_rad_s = std::nan("");
  mill.charge_initial_angle_rad = charge.quantity_or("initial_angle", "rad", any_angle(), 0,
                                                     "the charge begins on the side of the rest position");
  read_charge_lag(charge, contains(effects, effect_name::charge_lag), mill);
  charge.finish();
}

void read_structure(SceneTable structure, const std::vector<std::string>& effects,
                    kinetics::VibratoryMill& mill) {
  mill.structure_mass_kg = read_mass(
      structure, {effect_name::gravity_structure, effect_name::structure_inertia, effect_name::pitch},
      effects);
  mill.structure_centre_m = pair(structure, "centre", "m", between(-longest_machine_m, longest_machine_m));
  structure.know("pitch_inertia");
  if (contains(effects, effect_name::pitch) || structure.has("pitch_inertia"))
    mill.pitch_inertia_kg_m2 = structure.quantity("pitch_inertia", "kg m2", positive(1e9));
  const double least = mill.structure_mass_kg * mill.structure_centre_m.squaredNorm();
  if (structure.has("pitch_inertia") && mill.pitch_inertia_kg_m2 < least * (1 - 1e-12))
    structure.refuse("pitch_inertia", "is less than mass times |centre|^2 = " + shown(least, 6) +
                                          " kg m2, the least that a body with this centre of mass can have "
                                          "about the eccentric's axis; check mass, centre and unit");
  structure.finish();
}

std::optional<MillingSpace> read_chamber(SceneTable chamber, SceneTable charge,
                                         kinetics::VibratoryMill& mill) {
  mill.chamber_centre_m = pair(chamber, "centre", "m", between(-longest_machine_m, longest_machine_m));
  chamber.know("inner_radius");
  chamber.know("inner_length");
  std::optional<MillingSpace> space;
  if (chamber.has("inner_radius") || chamber.has("inner_length")) {
    const double radius_m = chamber.quantity("inner_radius", "m", positive(longest_machine_m));
    const double length_m = chamber.quantity("inner_length", "m", positive(longest_machine_m));
    space = MillingSpace{radius_m, length_m};
    if (mill.charge_offset_m >= radius_m) {
      charge.refuse("offset",
                    "the charge's centre of mass would lie outside the chamber, whose inner radius is " +
                        shown(radius_m) + " m; make it smaller");
    } else if (mill.charge_offset_m < radius_m && length_m > 0) {
      const double volume_m3 =
          largest_filling(mill.charge_offset_m, radius_m) * pi * radius_m * radius_m * length_m;
      const double density_kg_m3 = mill.charge_mass_kg / volume_m3;
      if (density_kg_m3 > most_bulk_density_kg_m3)
        charge.refuse("mass", "does not fit: with its centre " + shown(mill.charge_offset_m) +
                                  " m off the axis the charge has at most " +
                                  shown(std::floor(volume_m3 * 1e4) / 10) + " litres, a bulk density of " +
                                  shown(std::round(density_kg_m3)) +
                                  " kg/m3; check mass, offset and the chamber's inner size");
    }
  }
  chamber.finish();
  return space;
}

void read_springs(SceneTable& machine, const std::vector<std::string>& effects,
                  kinetics::VibratoryMill& mill) {
  const bool are_needed = contains(effects, effect_name::springs) ||
                          contains(effects, effect_name::spring_damping) ||
                          contains(effects, effect_name::pitch);
  if (!machine.has("springs") && !are_needed) return machine.know("springs");
  std::vector<SceneTable> springs = machine.tables("springs");
  for (SceneTable& table : springs) {
    kinetics::Spring spring;
    spring.position_m = pair(table, "position", "m", between(-longest_machine_m, longest_machine_m));
    spring.stiffness_N_m = pair(table, "stiffness", "N/m", not_negative(1e12));
    spring.damping_N_s_m = pair(table, "damping", "N s/m", not_negative(1e9));
    if (table.is_given("preload")) spring.preload_N = pair(table, "preload", "N", between(-1e9, 1e9));
    if (table.has("preload") != springs.front().has("preload"))
      table.refuse(
          "preload",
          "give a preload for every spring, or for none: then the static balance of the weights is taken");
    table.finish();
    mill.springs.push_back(spring);
  }
  if (springs.empty() && machine.has("springs"))
    machine.refuse("springs", "has no spring; add a table [[machine.springs]], or remove the spring effects");
  else if (!springs.empty() && !springs.front().has("preload") && contains(effects, effect_name::springs) &&
           mill.convention == kinetics::Convention::consistent)
    machine.record_default("springs.preload", "static balance", "the springs carry the weights at rest");

  double pitch_stiffness_N_m = 0;
  for (const kinetics::Spring& spring : mill.springs)
    pitch_stiffness_N_m += spring.stiffness_N_m.x() * std::pow(spring.position_m.y(), 2) +
                           spring.stiffness_N_m.y() * std::pow(spring.position_m.x(), 2);
  if (contains(effects, effect_name::pitch) && !springs.empty() && pitch_stiffness_N_m == 0)
    machine.refuse("springs",
                   "resist no pitch: every stiffness or lever is 0; give stiffness and position, or switch "
                   "the effect \"pitch\" off");
}

}  // namespace

double largest_filling(double offset_m, double radius_m) {
  // Centroid of the segment under a chord that subtends theta: 4 R sin^3(theta/2) / (3 (theta - sin theta));
  // it falls from R to 0 as theta grows to 2 pi.
  double low = 1e-3, high = 2 * pi;  // below: cancellation, and a filling of 1e-10
  for (int i = 0; i < 60; ++i) {
    const double theta = (low + high) / 2;
    const double centroid = 4.0 / 3 * std::pow(std::sin(theta / 2), 3) / (theta - std::sin(theta));
    (centroid > offset_m / radius_m ? low : high) = theta;
  }
  return (high - std::sin(high)) / (2 * pi);
}

kinetics::Convention read_convention(SceneTable& machine) {
  const std::string convention = machine.text_or(
      "convention", "consistent", "mechanics that closes; \"published\" is the paper to the letter");
  if (convention == "published") return kinetics::Convention::published;
  if (!convention.empty() && convention != "consistent")
    machine.refuse("convention",
                   "unknown convention; write \"consistent\" (mechanics that closes) or \"published\" "
                   "(the paper to the letter, loads only)");
  return kinetics::Convention::consistent;
}

std::optional<kinetics::RunUp> read_run_up(SceneTable& machine) {
  if (!machine.is_given("run_up")) return std::nullopt;
  SceneTable table = machine.table("run_up");
  kinetics::RunUp run;
  for (const char* name : {"from", "to", "duration", "hold", "times", "speeds"}) table.know(name);
  const bool is_table = table.has("times") || table.has("speeds");
  const Range speeds = not_negative(most_speed_rad_s), times = not_negative(1e5);
  if (is_table && (table.has("from") || table.has("to") || table.has("duration"))) {
    table.refuse_missing("", "mixes a ramp (from, to, duration) with a table (times, speeds); keep one");
  } else if (is_table) {
    run.time_s = table.list("times", "s", times);
    run.speed_rad_s = table.list("speeds", "rad/s", speeds);
    if (run.time_s.size() != run.speed_rad_s.size())
      table.refuse("speeds", "has " + std::to_string(run.speed_rad_s.size()) + " entries where times has " +
                                 std::to_string(run.time_s.size()) + "; give one speed for each time");
  } else {
    const double from = table.quantity("from", "rad/s", speeds), to = table.quantity("to", "rad/s", speeds),
                 duration = table.quantity("duration", "s", positive(1e5));
    const double hold = table.quantity_or("hold", "s", times, 0, "the run ends with the ramp");
    if (std::isfinite(from + to + duration + hold)) run = kinetics::ramp(from, to, duration, hold);
  }
  run.steps_per_instant =
      table.count_or("steps_per_instant", 1, 1000, 1, "every step of integration is an instant");
  table.finish();
  return run;
}

kinetics::VibratoryMill read_vibratory_mill(SceneTable& machine, kinetics::Convention convention,
                                            const std::vector<std::string>& effects,
                                            std::optional<MillingSpace>& milling_space,
                                            std::vector<std::string>* masses_from_mesh) {
  kinetics::VibratoryMill mill;
  mill.convention = convention;
  mill.gravity_m_s2 =
      machine.quantity_or("gravity", "m/s2", not_negative(100), 9.81, "gravity on the ground");
  read_drive(machine.table("drive"), mill);
  const SceneTable charge = machine.table("charge");
  read_charge(charge, effects, mill);
  // With [chamber] its mesh can tell what is not given here.
  if (machine.has("structure") || masses_from_mesh == nullptr) {
    read_structure(machine.table("structure"), effects, mill);
  } else {
    machine.know("structure");
    machine.record_default("structure", "from the mesh", "[chamber] and what is added to it");
    masses_from_mesh->push_back("structure");
  }
  milling_space = read_chamber(machine.table("chamber"), charge, mill);

  if (machine.has("exciter") || masses_from_mesh == nullptr) {
    SceneTable exciter = machine.table("exciter");
    mill.exciter_mass_kg =
        read_mass(exciter, {effect_name::gravity_exciter, effect_name::exciter_inertia}, effects);
    exciter.finish();
  } else {
    machine.know("exciter");
    machine.record_default("exciter", "from the mesh", "the housing of [chamber] and what is added to it");
    masses_from_mesh->push_back("exciter");
  }
  SceneTable debalance = machine.table("debalance");
  mill.debalance_mass_kg = read_mass(debalance, {"gravity_debalance", "debalance_inertia"}, effects);
  mill.debalance_offset_m = debalance.quantity("offset", "m", between(-10, 10));
  debalance.finish();

  read_springs(machine, effects, mill);
  machine.finish();
  return mill;
}

}  // namespace pipelines
