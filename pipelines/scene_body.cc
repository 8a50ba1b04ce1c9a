#include "pipelines/scene_body.h"

#include <algorithm>
#include <cmath>

#include "pipelines/nearest.h"

namespace pipelines {
namespace {

void read_material(SceneTable material, BodyScene& body) {
  body.material_name = material.text("name");
  body.material.youngs_modulus_Pa = material.quantity("youngs_modulus", "Pa", between(1e8, 2e12));
  body.material.poisson_ratio = material.quantity("poisson_ratio", "1", between(0, 0.49));
  body.material.density_kg_m3 = material.quantity("density", "kg/m3", between(100, 30000));
  body.yield_strength_Pa = material.quantity("yield_strength", "Pa", between(1e6, 1e10));
  material.finish();
}

/// "uniform", "parabolic", or values along the seat.
std::vector<double> read_axial_profile(SceneTable& table) {
  table.know("axial");
  if (!table.has("axial")) return {1};
  if (table.has_list("axial")) {
    auto values = table.list("axial", "1", not_negative(1e6));
    if (values.size() == 1 || std::all_of(values.begin(), values.end(), [](double v) { return v == 0; }))
      table.refuse("axial", "needs two values or more along the seat, not all zero");
    return values;
  }
  const std::string shape = table.text("axial");
  if (shape == "parabolic") {
    std::vector<double> values;
    constexpr int n = 16;  // straight lines between: the parabola is met to 1/256 of its height
    for (int i = 0; i <= n; ++i) values.push_back(1 - std::pow(2.0 * i / n - 1, 2));
    return values;
  }
  if (!shape.empty() && shape != "uniform")
    table.refuse("axial",
                 "unknown shape; write \"uniform\", \"parabolic\" or a list of values along the seat");
  return {1};
}

PressureModel read_pressure(SceneTable table, int usual_harmonics) {
  PressureModel model;
  const std::string pattern =
      table.text_or("pattern", "cosine", "of a pin in a bed; \"uniform\" is a belt over its arc of wrap");
  if (pattern == "uniform")
    model.pattern.kind = PressurePattern::Kind::uniform;
  else if (!pattern.empty() && pattern != "cosine")
    table.refuse("pattern", "unknown pattern; write \"cosine\" or \"uniform\"");
  const bool uniform = model.pattern.kind == PressurePattern::Kind::uniform;
  model.pattern.half_angle_rad = table.quantity_or(
      "half_angle", "rad", {0, uniform ? M_PI * (1 - 1e-6) : M_PI, true}, M_PI / 2,
      "of contact: 90 degrees is the half-cosine, less with clearance, more with interference");
  model.highest_harmonic = table.count_or("harmonics", 0, 64, usual_harmonics, "as pressure_harmonics");
  model.axial_profile = read_axial_profile(table);
  table.finish();
  return model;
}

void read_pressures(SceneTable& table, BodyScene& body) {
  body.pressure_harmonics =
      table.count_or("pressure_harmonics", 0, 64, body.pressure_harmonics, "of the seat pressure");
  if (body.pressure_harmonics % 2 != 0)
    table.refuse("pressure_harmonics",
                 "must be even: a half-cosine has no odd harmonic above the first; write " +
                     std::to_string(body.pressure_harmonics + 1));
  table.know("pressure");
  if (!table.has("pressure")) return;
  SceneTable pressures = table.table("pressure");
  for (const auto& port : pressures.names())
    body.pressures[port] = read_pressure(pressures.table(port), body.pressure_harmonics);
  pressures.finish();
}

void read_added_masses(SceneTable& table, BodyScene& body) {
  table.know("added_masses");
  if (table.has("added_masses"))
    for (SceneTable& entry : table.tables("added_masses")) {
      AddedMass added;
      added.name = entry.text("name");
      added.port = entry.text("port");
      added.mass_kg = entry.quantity("mass", "kg", positive(1e6));
      added.polar_inertia_kg_m2 =
          entry.quantity_or("polar_inertia", "kg m2", not_negative(1e9), 0, "about its own centre");
      entry.know("offset");
      if (entry.has("offset")) {
        const auto offset = entry.quantities("offset", "m", between(-100, 100), 2);
        if (offset.size() == 2) added.centre_m = {offset[0], offset[1]};
      }
      if (body.role == BodyRole::chamber) {
        added.region = entry.text_or("moves_with", added.port == "housing_bore" ? "exciter" : "structure",
                                     "by its port; whose mass it counts to");
        if (added.region != "structure" && added.region != "exciter" && !added.region.empty())
          entry.refuse("moves_with", "write \"structure\" or \"exciter\"");
      }
      entry.finish();
      body.added_masses.push_back(added);
    }
  const char* usual = body.role == BodyRole::chamber       ? "covers"
                      : body.role == BodyRole::drum        ? "pulley_seat"
                      : body.role == BodyRole::train_shaft ? "pulley_seat"
                                                           : nullptr;
  if (usual != nullptr)
    body.difference_port =
        table.text_or("difference_port", usual, "carries what the machine's masses and the mesh's differ by");
}

void read_debalances(SceneTable& table, BodyScene& body) {
  table.know("debalance_shares");
  if (!table.has("debalance_shares"))
    return table.record_default("debalance_shares", "[0.5, 0.5]", "both debalances alike");
  body.debalance_shares = table.quantities("debalance_shares", "1", between(0, 1), 2);
  if (std::abs(body.debalance_shares[0] + body.debalance_shares[1] - 1) > 1e-9)
    table.refuse("debalance_shares", "must add up to 1: they are the shares of one mass");
}

void read_stub_axle(SceneTable& table, BodyScene& body) {
  auto& axle = body.stub_axle;
  axle.bearing_span_m = table.quantity("bearing_span", "m", positive(100));
  axle.pulley_plane_m = table.quantity("pulley_plane", "m", between(-100, 100));
  axle.pulley_mass_kg =
      table.quantity_or("pulley_mass", "kg", not_negative(1e6), 0, "all of the drum at mid-span");
  const std::string side = table.text_or("side", "plain", "the stub that carries more; or \"pulley\"");
  axle.pulley_side = side != "plain";
  if (!side.empty() && side != "plain" && side != "pulley")
    table.refuse("side", "write \"pulley\" or \"plain\": which of the two stubs");
}

void read_train_shaft(SceneTable& table, const kinetics::DriveTrain& train, BodyScene& body) {
  auto& shaft = body.train;
  shaft.inertia = table.text("inertia");
  std::vector<std::string> inertias, elements;
  for (const auto& inertia : train.inertias) inertias.push_back(inertia.name);
  if (!shaft.inertia.empty() && std::find(inertias.begin(), inertias.end(), shaft.inertia) == inertias.end())
    table.refuse("inertia", "the train has no such inertia; it has " + listed(inertias));
  for (const auto& element : train.elements)
    if (element.first == shaft.inertia || element.second == shaft.inertia) elements.push_back(element.name);
  std::vector<std::string> entered;
  for (SceneTable& entry : table.tables("torques")) {
    const std::string port = entry.text("port"), element = entry.text("element");
    if (!element.empty() && std::find(elements.begin(), elements.end(), element) == elements.end())
      entry.refuse("element", "does not join \"" + shaft.inertia + "\" to anything; its elements are " +
                                  listed(elements));
    shaft.torques.push_back({port, element + "_on_" + shaft.inertia});
    entered.push_back(element);
    entry.finish();
  }
  for (const auto& element : elements)
    if (table.has("torques") && std::find(entered.begin(), entered.end(), element) == entered.end())
      table.refuse("torques",
                   "the torque of \"" + element + "\" enters nowhere, so that nothing would balance; add it");
  table.know("bearings");
  if (table.has("bearings")) {
    const auto names = table.texts("bearings");
    if (names.size() != 2)
      table.refuse("bearings", "needs the ports of two bearings");
    else
      shaft.bearings = {names[0].text, names[1].text};
  }
  shaft.axial_bearing = table.text_or("axial_bearing", shaft.bearings[0], "takes forces along the shaft");
  table.know("forces");
  if (table.has("forces"))
    for (SceneTable& entry : table.tables("forces")) {
      TrainShaftOptions::Force force;
      force.effect = entry.text("effect");
      force.port = entry.text("port");
      const auto value = entry.quantities("force", "N", between(-1e9, 1e9), 3);
      if (value.size() == 3) force.force_N = {value[0], value[1], value[2]};
      force.turns_with_shaft = entry.flag_or("turns_with_shaft", false, "it stands still in space");
      entry.finish();
      shaft.forces.push_back(force);
    }
}

void read_supports(SceneTable& table, BodyScene& body) {
  table.know("bearings");
  if (table.has("bearings")) {
    for (const auto& name : table.texts("bearings")) body.table.bearings.push_back(name.text);
    if (body.table.bearings.size() != 2) table.refuse("bearings", "needs the ports of two bearings");
  }
  for (auto* support : {&body.table.axial_support, &body.table.torque_support}) {
    const char* key = support == &body.table.axial_support ? "axial_support" : "torque_support";
    table.know(key);
    if (table.has(key)) *support = table.text(key);
  }
}

ContourRules contour_rules(BodyRole role, const Scene& scene, const BodyScene& body) {
  ContourRules rules;
  switch (role) {
    case BodyRole::vibratory_shaft:
      rules.ports = {"eccentric_seat", "main_bearing_1", "main_bearing_2",
                     "debalance_1",    "debalance_2",    "coupling"};
      rules.middle = rules.eccentric_seat = "eccentric_seat";
      rules.eccentricity_m = scene.vibratory_mill().eccentricity_m;
      break;
    case BodyRole::drum:
      rules.ports = {"inner_wall", "trunnion_1", "trunnion_2", "pulley_seat"};
      rules.middle = "inner_wall";
      break;
    case BodyRole::stub_axle:
      rules.ports = {"bearing", "clamp"};
      break;
    case BodyRole::train_shaft:
      rules.ports = {body.train.bearings[0], body.train.bearings[1]};
      for (const auto& torque : body.train.torques) rules.ports.push_back(torque.port);
      for (const auto& force : body.train.forces) rules.ports.push_back(force.port);
      break;
    case BodyRole::table_body:
      rules.any_port = true;
      rules.ports = body.table.bearings;
      break;
    case BodyRole::chamber:
      break;
  }
  return rules;
}

}  // namespace

BodyScene read_body(SceneTable& table, BodyRole role, const Scene& scene, SceneFindings& findings) {
  BodyScene body;
  body.name = table.key();
  body.role = role;
  if (role == BodyRole::vibratory_shaft) read_debalances(table, body);
  if (role == BodyRole::stub_axle) read_stub_axle(table, body);
  if (role == BodyRole::train_shaft)
    read_train_shaft(table, std::get<kinetics::DriveTrain>(scene.machine), body);
  if (role == BodyRole::table_body) read_supports(table, body);
  if (role == BodyRole::chamber) {
    body.shape = read_chamber_shape(table, scene.vibratory_mill(), scene.milling_space);
    const std::string guide =
        table.text_or("pitch_guide", "body", "where the couple of a held attitude goes");
    if (guide == "feet")
      body.pitch_guide = PitchGuide::feet;
    else if (!guide.empty() && guide != "body")
      table.refuse("pitch_guide", "write \"body\" (a body load about the mass centre) or \"feet\"");
    body.elastic_feet = table.flag_or("elastic_feet", false, "the springs' stiffness is no part of the body");
  } else {
    body.shape = read_shaft_shape(table, contour_rules(role, scene, body), findings);
  }
  read_pressures(table, body);
  if (role != BodyRole::vibratory_shaft && role != BodyRole::stub_axle && role != BodyRole::table_body)
    read_added_masses(table, body);
  read_material(table.table("material"), body);
  table.finish();
  return body;
}

std::vector<std::string> force_ports(const BodyScene& body) {
  switch (body.role) {
    case BodyRole::vibratory_shaft:
      return {"main_bearing_1", "main_bearing_2", "eccentric_seat"};
    case BodyRole::chamber:
      return {"housing_bore"};
    case BodyRole::drum:
      return {"trunnion_1", "trunnion_2"};
    case BodyRole::stub_axle:
      return {"bearing"};
    case BodyRole::train_shaft:
      return body.train.forces.empty()
                 ? std::vector<std::string>{}
                 : std::vector<std::string>(body.train.bearings.begin(), body.train.bearings.end());
    case BodyRole::table_body:
      return body.table.bearings;
  }
  return {};
}

}  // namespace pipelines
