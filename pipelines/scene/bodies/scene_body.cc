#include "pipelines/scene/bodies/scene_body.h"

#include "pipelines/scene/bodies/scene_body_parts.h"
#include "pipelines/scene/bodies/scene_fatigue.h"
#include "pipelines/scene/whole/body_reader.h"

namespace pipelines {
namespace {

void read_added_masses(SceneTable& table, const BodyReader& kind, BodyScene& body) {
  for (SceneTable& entry : table.tables_if_any("added_masses")) {
    AddedMass added;
    added.name = entry.name("name");
    added.port = entry.text("port");
    check_port(entry, "port", added.port, ports_of(body).all, "the ports of this body");
    added.mass_kg = entry.quantity("mass", "kg", positive(1e6));
    added.polar_inertia_kg_m2 =
        entry.quantity_or("polar_inertia", "kg m2", not_negative(1e9), 0, "about its own centre");
    if (entry.is_given("offset")) {
      const auto offset = entry.quantities("offset", "m", between(-100, 100), 2);
      if (offset.size() == 2) added.centre_m = {offset[0], offset[1]};
    }
    kind.read_region(entry, added);
    entry.finish();
    body.added_masses.push_back(added);
  }
  const auto usual = kind.usual_difference_port(body);
  if (!usual) return;
  body.difference_port =
      table.text_or("difference_port", *usual, "carries what the machine's masses and the mesh's differ by");
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
  if (table.is_given("natural_frequencies"))
    body.natural_frequencies = table.count_or("natural_frequencies", 0, most, 0, "not asked for");
}

void read_bearing_stiffness(SceneTable& table, std::size_t n_bearings, BodyScene& body) {
  constexpr double most_N_m = 1e13;
  if (!table.is_given("bearing_stiffness")) return;
  auto& stiffness = body.bearing_stiffness_N_m;
  if (table.has_list("bearing_stiffness"))
    stiffness = table.quantities("bearing_stiffness", "N/m", positive(most_N_m), n_bearings);
  else
    stiffness.assign(n_bearings, table.quantity("bearing_stiffness", "N/m", positive(most_N_m)));
  if (body.critical_speeds == 0 && body.natural_frequencies == 0)
    table.refuse("bearing_stiffness",
                 "nothing asks for it; add critical_speeds = 3 (or natural_frequencies = 3)");
}

/// Of shafts, whose bearings stand in space; those of a planetary mill's bodies go round with its carrier.
void read_critical_speeds(SceneTable& table, const BodyReader& kind, BodyScene& body) {
  constexpr int most = 10;  // in each direction; no load of a mill reaches the tenth
  if (body.name != "shaft") return;
  if (table.is_given("critical_speeds"))
    body.critical_speeds = table.count_or("critical_speeds", 0, most, 0, "not asked for");
  constexpr std::size_t n_bearings = 2;
  const bool has_bearings = !kind.is_clamped(body) && kind.supporting_ports(body).size() == n_bearings;
  for (const char* key : {"critical_speeds", "bearing_stiffness"})
    if (table.has(key) && !has_bearings)
      table.refuse(key, "the shaft has no two bearings; name their ports in bearings, without a clamp");
  if (body.critical_speeds > 0 && body.shaft() == nullptr)
    table.refuse("critical_speeds",
                 "needs the segments of a contour, and the shaft comes from a file; "
                 "natural_frequencies has those of a file at rest");
  read_bearing_stiffness(table, n_bearings, body);
}

}  // namespace

BodyScene read_body(SceneTable& table, const BodyReader& kind, const Scene& scene, SceneFindings& findings) {
  BodyScene body;
  body.name = table.key();
  body.origin = table.origin();
  body.mesh_keys = table.places_in("mesh");
  body.options = kind.read_options(table, scene);
  if (table.is_given("file"))
    body.shape = read_import(table, scene.file.parent_path(), kind.contour_rules(scene, body).ports);
  else
    body.shape = kind.read_shape(table, scene, body, findings);
  kind.check_ports(table, body);
  read_pressures(table, body);
  if (kind.shares_masses()) read_added_masses(table, kind, body);
  const auto strength = read_material(table, body, findings);
  read_solver(table, body);
  read_natural_frequencies(table, body);
  read_critical_speeds(table, kind, body);
  read_fatigue(table, strength, bool(scene.run_up), body, findings);
  if (body.fatigue && !body.fatigue->wanted_life_s) body.fatigue->wanted_life_s = scene.limits.wanted_life_s;
  table.finish();
  return body;
}

}  // namespace pipelines
