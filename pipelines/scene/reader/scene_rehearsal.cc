#include "kinetics/values/machine_refused.h"
#include "meshes/chamber/chamber_checks.h"
#include "meshes/keyed_shaft/solid_shaft.h"
#include "meshes/shaft_layout/shaft_checks.h"
#include "meshes/values/refused.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/reader/scene_stages.h"
#include "pipelines/scene/values/known_forces.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

/// A bearing's load must be one that the load stage gives, or that a body adds.
void check_bearings(const Scene& scene, const kinetics::LoadHistory& loads, SceneTable& root) {
  std::vector<std::string> of_bodies;
  for (const auto& body : scene.bodies) {
    const auto own = reader_of(body).bearing_loads(body);
    of_bodies.insert(of_bodies.end(), own.begin(), own.end());
  }
  for (const auto& load : kind_of(scene.machine).added_loads(scene)) of_bodies.push_back(load);
  for (const auto& bearing : scene.bearings)
    if (!force_of(bearing.load, loads) && !contains(of_bodies, bearing.load))
      root.refuse("bearings", "the load \"" + bearing.load + "\" of \"" + bearing.name +
                                  "\" is no force here; known are: " + listed(known_forces(loads)) +
                                  (of_bodies.empty() ? "" : ", " + listed(of_bodies)));
}

/// @throws meshes::GeometryRefused as the mesher, without meshing
void check_shape(const BodyScene& body) {
  if (const auto* shaft = body.shaft()) {
    if (shaft->keyways.empty()) {
      meshes::check_shaft(shaft->geometry);
      meshes::check_cells(shaft->geometry, shaft->mesh);
    } else {
      meshes::check_solid_shaft(shaft->geometry, shaft->keyways, shaft->solid);
    }
  }
  if (const auto* chamber = std::get_if<ChamberShape>(&body.shape)) {
    const auto& [geometry, control] = *chamber;
    meshes::check_control(control);
    meshes::check_sizes(geometry);
    const auto layout = meshes::lay_out(geometry, control);
    meshes::check_cells(geometry, layout, control);
    meshes::check_clearances(geometry, layout);
  }
}

}  // namespace

void rehearse(const Scene& scene, SceneTable& root, SceneTable& machine, std::vector<SceneTable>& bodies,
              const VersionReading& version) {
  try {
    const MachineKind& kind = kind_of(scene.machine);
    if (!scene.bodies.empty()) kind.refuse_open_balance(scene, machine);
    const bool is_left_to_loads = version.loads_follow && !scene.run_up && scene.masses_from_mesh.empty();
    if (!is_left_to_loads)
      if (const auto loads = kind.rehearse(scene)) check_bearings(scene, *loads, root);
  } catch (const kinetics::MachineRefused& error) {
    machine.refuse_missing("", "the load stage refuses it: " + std::string(error.what()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) try {
      const auto& is_accepted = version.has_accepted_shape;
      if (!is_accepted || !is_accepted(scene.bodies[i])) check_shape(scene.bodies[i]);
    } catch (const meshes::TooManyCells& error) {
      bodies[i].table_or_empty("mesh").refuse(mesh_key(error.control()), error.what());
    } catch (const meshes::GeometryRefused& error) {
      const std::string remedy = "the mesher refuses it: " + std::string(error.what());
      scene.bodies[i].shaft() ? bodies[i].refuse("contour", remedy) : bodies[i].refuse_missing("", remedy);
    }
}

}  // namespace pipelines
