#include "pipelines/scene/scene_body.h"

#include <algorithm>
#include <cmath>

#include "pipelines/scene/scene_body_parts.h"

namespace pipelines {
namespace {

void read_material(SceneTable material, BodyScene& body) {
  body.material_name = material.text("name");
  body.material.youngs_modulus_Pa = material.quantity("youngs_modulus", "Pa", between(1e8, 2e12));
  body.material.poisson_ratio = material.quantity("poisson_ratio", "1", between(0, 0.4999));
  body.material.density_kg_m3 = material.quantity("density", "kg/m3", between(100, 30000));
  body.yield_strength_Pa = material.quantity("yield_strength", "Pa", between(1e6, 1e10));
  material.finish();
}

const char* first_torque_port(const BodyScene& body) {
  return body.train.torques.empty() ? nullptr : body.train.torques.front().port.c_str();
}

void read_added_masses(SceneTable& table, BodyScene& body) {
  table.know("added_masses");
  if (table.has("added_masses"))
    for (SceneTable& entry : table.tables("added_masses")) {
      AddedMass added;
      added.name = entry.text("name");
      added.port = entry.text("port");
      check_port(entry, "port", added.port, ports_of(body).all, "the ports of this body");
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
                      : body.role == BodyRole::train_shaft ? first_torque_port(body)
                                                           : nullptr;
  if (usual == nullptr) return;
  body.difference_port =
      table.text_or("difference_port", usual, "carries what the machine's masses and the mesh's differ by");
  check_port(table, "difference_port", body.difference_port, ports_of(body).all, "the ports of this body");
}

void read_solver(SceneTable& table, BodyScene& body) {
  const std::string solver =
      table.text_or("solver", "automatic", "the faster one of those that suit the body");
  if (solver == "direct") body.solver = fem::Solver::direct;
  if (solver == "iterative") body.solver = fem::Solver::iterative;
  if (!solver.empty() && solver != "automatic" && solver != "direct" && solver != "iterative")
    table.refuse("solver",
                 "write \"automatic\", \"direct\" (a factorisation) or \"iterative\" (conjugate gradients)");
}

void read_natural_frequencies(SceneTable& table, BodyScene& body) {
  constexpr int most = 50;  // above them a body's modes are no concern of its bearings' harmonics
  table.know("natural_frequencies");
  if (table.has("natural_frequencies"))
    body.natural_frequencies = table.count_or("natural_frequencies", 0, most, 0, "not asked for");
}

void read_debalances(SceneTable& table, BodyScene& body) {
  table.know("debalance_shares");
  if (!table.has("debalance_shares"))
    return table.record_default("debalance_shares", "[0.5, 0.5]", "both debalances alike");
  body.debalance_shares = table.quantities("debalance_shares", "1", between(0, 1), 2);
  if (std::abs(body.debalance_shares[0] + body.debalance_shares[1] - 1) > 1e-9)
    table.refuse("debalance_shares", "must add up to 1: they are the shares of one mass");
}

void read_stub_axle(SceneTable& table, const kinetics::PlanetaryMill& mill, BodyScene& body) {
  auto& axle = body.stub_axle;
  axle.bearing_span_m = table.quantity("bearing_span", "m", positive(100));
  axle.pulley_plane_m = table.quantity("pulley_plane", "m", between(-100, 100));
  axle.pulley_mass_kg =
      table.quantity_or("pulley_mass", "kg", not_negative(1e6), 0, "all of the drum at mid-span");
  if (axle.pulley_mass_kg > mill.drum_mass_kg)
    table.refuse("pulley_mass", "is more than machine.drum.mass, of which it is a part: " +
                                    shown(mill.drum_mass_kg) + " kg; check both");
  const std::string side = table.text_or("side", "plain", "the stub that carries more; or \"pulley\"");
  axle.pulley_side = side != "plain";
  if (!side.empty() && side != "plain" && side != "pulley")
    table.refuse("side", "write \"pulley\" or \"plain\": which of the two stubs");
}

void read_supports(SceneTable& table, BodyScene& body) {
  table.know("bearings");
  if (table.has("bearings")) {
    for (const auto& name : table.texts("bearings")) body.table.bearings.push_back(name.text);
    const auto& bearings = body.table.bearings;
    if (bearings.size() != 2 || bearings[0] == bearings[1])
      table.refuse("bearings", "needs the ports of two bearings");
  }
  for (auto* support : {&body.table.axial_support, &body.table.torque_support}) {
    const char* key = support == &body.table.axial_support ? "axial_support" : "torque_support";
    table.know(key);
    if (table.has(key)) *support = table.text(key);
  }
}

/// Ports that the loads of a table enter by; end faces are always there.
void add_table_ports(const Scene& scene, std::vector<std::string>& ports) {
  for (const auto& load : std::get<kinetics::LoadTable>(scene.machine).loads) {
    const bool is_face = load.port == "end_1" || load.port == "end_2" || load.port == "volume";
    if (!is_face && scene.has_effect(load.effect) &&
        std::find(ports.begin(), ports.end(), load.port) == ports.end())
      ports.push_back(load.port);
  }
}

/// Forces need a surface, accelerations the whole body.
void check_table_loads(SceneTable& body, const Scene& scene) {
  for (const auto& load : std::get<kinetics::LoadTable>(scene.machine).loads) {
    const auto& c = load.component;
    const bool is_field = c == "ax" || c == "ay" || c == "az" || c == "spin";
    if (!scene.has_effect(load.effect) || is_field == (load.port == "volume")) continue;
    const std::string name = "the load \"" + load.port + "." + c + "\" ";
    body.refuse_missing("", is_field ? name + "belongs to the whole body; write \"volume." + c + "\""
                                     : name +
                                           "has no place to enter: the body as a whole takes ax, ay, az "
                                           "and spin; name a port");
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
      rules.any_port = true;
      rules.ports = {body.train.bearings[0], body.train.bearings[1]};
      for (const auto& torque : body.train.torques) rules.ports.push_back(torque.port);
      for (const auto& force : body.train.forces) rules.ports.push_back(force.port);
      break;
    case BodyRole::table_body:
      rules.any_port = true;
      rules.ports = body.table.bearings;
      add_table_ports(scene, rules.ports);
      break;
    case BodyRole::chamber:
      break;
  }
  return rules;
}

std::vector<std::string> needed_ports(BodyRole role, const Scene& scene, const BodyScene& body) {
  if (role != BodyRole::chamber) return contour_rules(role, scene, body).ports;
  std::vector<std::string> ports{"housing_bore", "inner_wall"};
  for (std::size_t i = 1; i <= scene.vibratory_mill().springs.size(); ++i)
    ports.push_back("spring_foot_" + std::to_string(i));
  return ports;
}

/// Opposite forces on the first two feet make a couple only at a distance.
void read_guide_by_feet(SceneTable& table, const kinetics::VibratoryMill& mill, BodyScene& body) {
  body.pitch_guide = PitchGuide::feet;
  const auto& springs = mill.springs;
  if (springs.size() < 2 || springs[0].position_m.x() == springs[1].position_m.x())
    table.refuse("pitch_guide",
                 "needs two springs, one beside the other, to pull and push by; write \"body\"");
}

/// Ports of supports that are no segments: the contour has not asked for them.
void check_supports(SceneTable& table, const BodyScene& body) {
  const auto known = ports_of(body).all;
  if (body.role == BodyRole::train_shaft)
    check_port(table, "axial_bearing", body.train.axial_bearing, known, "the ports of this body");
  if (body.role != BodyRole::table_body) return;
  check_port(table, "axial_support", body.table.axial_support, known, "the ports of this body");
  check_port(table, "torque_support", body.table.torque_support, known, "the ports of this body");
}

}  // namespace

BodyScene read_body(SceneTable& table, BodyRole role, const Scene& scene, SceneFindings& findings) {
  BodyScene body;
  body.name = table.key();
  body.origin = table.origin();
  body.role = role;
  if (role == BodyRole::vibratory_shaft) read_debalances(table, body);
  if (role == BodyRole::stub_axle)
    read_stub_axle(table, std::get<kinetics::PlanetaryMill>(scene.machine), body);
  if (role == BodyRole::train_shaft)
    read_train_shaft(table, std::get<kinetics::DriveTrain>(scene.machine), body);
  if (role == BodyRole::table_body) {
    read_supports(table, body);
    check_table_loads(table, scene);
  }
  if (role == BodyRole::chamber) {
    const std::string guide =
        table.text_or("pitch_guide", "body", "where the couple of a held attitude goes");
    if (guide == "feet")
      read_guide_by_feet(table, scene.vibratory_mill(), body);
    else if (!guide.empty() && guide != "body")
      table.refuse("pitch_guide", "write \"body\" (a body load about the mass centre) or \"feet\"");
    body.elastic_feet = table.flag_or("elastic_feet", false, "the springs' stiffness is no part of the body");
  }
  table.know("file");
  if (table.has("file"))
    body.shape = read_import(table, scene.file.parent_path(), needed_ports(role, scene, body));
  else if (role == BodyRole::chamber)
    body.shape = read_chamber_shape(table, scene.vibratory_mill(), scene.milling_space);
  else
    body.shape = read_shaft_shape(table, contour_rules(role, scene, body), findings);
  check_supports(table, body);
  read_pressures(table, body);
  if (role != BodyRole::vibratory_shaft && role != BodyRole::stub_axle && role != BodyRole::table_body)
    read_added_masses(table, body);
  read_material(table.table("material"), body);
  read_solver(table, body);
  read_natural_frequencies(table, body);
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
