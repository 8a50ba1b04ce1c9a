#include "pipelines/scene/machines/planetary_mill_reader.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/scene/values/effect_names.h"

namespace pipelines {
namespace {

constexpr double shortest_m = 1e-4, longest_m = 100;
constexpr double least_ratio = 1e-3;  // least ratio of lengths that are built beside each other

using kinetics::PlanetaryConvention;
using kinetics::PlanetaryMill;

bool any_of(const std::vector<std::string>& effects, const std::vector<std::string>& users) {
  return std::any_of(users.begin(), users.end(), [&](const std::string& user) {
    return std::find(effects.begin(), effects.end(), user) != effects.end();
  });
}

void read_geometry(SceneTable geometry, PlanetaryMill& mill) {
  const std::vector<std::string> ratios{"k", "b", "c"},
      lengths{"carrier_length", "central_pulley_radius", "drum_pulley_radius"};
  for (const auto* names : {&ratios, &lengths})
    for (const auto& name : *names) geometry.know(name);
  const auto has_any = [&](const auto& names) {
    return std::any_of(names.begin(), names.end(), [&](const auto& name) { return geometry.has(name); });
  };
  if (has_any(ratios) && has_any(lengths)) {
    geometry.refuse_missing("", "mixes the ratios k, b, c with lengths; keep one of the two sets");
  } else if (has_any(lengths)) {
    kinetics::PlanetaryLengths l;
    l.carrier_m = geometry.quantity("carrier_length", "m", between(shortest_m, longest_m));
    l.central_pulley_m = geometry.quantity("central_pulley_radius", "m", between(shortest_m, longest_m));
    l.drum_pulley_m = geometry.quantity("drum_pulley_radius", "m", between(shortest_m, longest_m));
    mill.geometry = l;
  } else {
    kinetics::PlanetaryRatios r;
    r.k = geometry.quantity("k", "1", between(least_ratio, 0.99));
    r.b = geometry.quantity("b", "1", between(least_ratio, 100));
    r.c = geometry.quantity("c", "1", between(least_ratio, 100));
    mill.geometry = r;
  }
  geometry.finish();
}

void read_charge(SceneTable charge, PlanetaryMill& mill) {
  mill.charge.bulk_density_kg_m3 = charge.quantity("bulk_density", "kg/m3", positive(3e4));
  mill.charge.segment_angle_rad = charge.quantity("segment_angle", "rad", between(-pi, pi));
  std::vector<std::string> given;
  for (const char* name : {"filling", "void", "half_angle"}) {
    if (charge.is_given(name)) given.push_back(name);
  }
  if (given.empty()) {
    charge.refuse_missing(
        "filling",
        "is missing, and so are void and half_angle; add one of them: the filled share of the "
        "drum's cross-section, the empty one, or the half angle of the charge's segment");
  } else if (given.size() > 1) {
    charge.refuse(given[1], "says the same as " + given[0] + "; keep one of the two");
  } else if (given[0] == "half_angle") {
    mill.charge.half_angle_rad = charge.quantity("half_angle", "rad", between(0, pi));
  } else {
    (given[0] == "void" ? mill.charge.void_fraction : mill.charge.filling) =
        charge.quantity(given[0], "1", between(0, 1));
  }
  charge.finish();
}

void read_belt(SceneTable belt, PlanetaryMill& mill) {
  const std::string model = belt.text("model");
  for (const char* name : {"ratio", "friction", "pretension"}) belt.know(name);
  if (model == "ratio") {
    mill.belt = kinetics::RatioBelt{belt.quantity("ratio", "1", {1, 1e6, true})};
  } else if (model == "eytelwein") {
    mill.belt = kinetics::EytelweinBelt{belt.quantity("friction", "1", positive(10))};
  } else if (model == "pretension") {
    const double pretension_N = belt.quantity("pretension", "N", not_negative(1e9));
    mill.belt = kinetics::PretensionedBelt{pretension_N, belt.quantity("friction", "1", positive(10))};
  } else if (!model.empty()) {
    belt.refuse(
        "model",
        "unknown belt; write \"ratio\" (T1 = ratio T2), \"eytelwein\" (as slack as friction allows) or "
        "\"pretension\" (T1 + T2 = 2 F0)");
  }
  mill.belt_beyond_geometry =
      belt.flag_or("beyond_geometry", false, "a machine whose pulleys contain each other has no belt");
  if (mill.belt_beyond_geometry && mill.convention == PlanetaryConvention::consistent)
    belt.refuse(
        "beyond_geometry",
        "is for the two conventions of the paper, which take cos beta = 0 there; remove it, or choose "
        "convention = \"as_plotted\" or \"as_published\"");
  belt.finish();
}

}  // namespace

PlanetaryConvention read_planetary_convention(SceneTable& machine) {
  const std::string convention = machine.text_or(
      "convention", "consistent", "mechanics that closes; \"as_published\" is the paper to the letter");
  if (convention == "as_published") return PlanetaryConvention::as_published;
  if (convention == "as_plotted") return PlanetaryConvention::as_plotted;
  if (!convention.empty() && convention != "consistent")
    machine.refuse("convention",
                   "unknown convention; write \"consistent\" (mechanics that closes), \"as_published\" (the "
                   "paper's formulas) or \"as_plotted\" (what reproduces its figures)");
  return PlanetaryConvention::consistent;
}

PlanetaryMill read_planetary_mill(SceneTable& machine, PlanetaryConvention convention,
                                  const std::vector<std::string>& effects, bool& drum_axes,
                                  bool has_drum_body, bool& mass_from_mesh) {
  PlanetaryMill mill;
  mill.convention = convention;
  mill.gravity_m_s2 =
      machine.quantity_or("gravity", "m/s2", not_negative(100), 9.81, "gravity on the ground");
  SceneTable carrier = machine.table("carrier");
  mill.speed_rad_s = carrier.quantity("speed", "rad/s", positive(1e4));
  mill.initial_angle_rad =
      carrier.quantity_or("initial_angle", "rad", any_angle(), 0, "OA is level at first");
  carrier.finish();
  SceneTable drum = machine.table("drum");
  mill.drum_radius_m = drum.quantity("inner_radius", "m", positive(longest_m));
  mill.drum_length_m = drum.quantity("length", "m", positive(longest_m));
  if (drum.has("mass") || !has_drum_body) {
    mill.drum_mass_kg = drum.quantity("mass", "kg", not_negative(1e6));
  } else {
    drum.know("mass");
    drum.record_default("mass", "from the mesh", "[drum] and what is added to it");
    mass_from_mesh = true;
  }
  mill.initial_drum_angle_rad =
      drum.quantity_or("initial_angle", "rad", any_angle(), 0, "the drum's axes are the carrier's at first");
  drum_axes = drum.flag_or("turning_axes", false, "loads in the carrier's frame only");
  drum.finish();
  read_geometry(machine.table("geometry"), mill);
  for (const char* name : {"charge", "belt"}) machine.know(name);
  const bool has_charge = any_of(effects, {"charge_transport", effect_name::charge_relative,
                                           effect_name::charge_offset, "charge_gravity"});
  if (machine.has("charge") || has_charge) read_charge(machine.table("charge"), mill);
  if (machine.has("belt") || any_of(effects, {effect_name::belt})) read_belt(machine.table("belt"), mill);
  machine.finish();
  return mill;
}

}  // namespace pipelines
