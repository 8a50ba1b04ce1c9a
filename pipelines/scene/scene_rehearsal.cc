#include <algorithm>
#include <cmath>

#include "kinetics/machine_refused.h"
#include "meshes/chamber/chamber_checks.h"
#include "meshes/keyed_shaft/solid_shaft.h"
#include "meshes/shaft/shaft_checks.h"
#include "meshes/values/refused.h"
#include "pipelines/common/name_lists.h"
#include "pipelines/common/nearest_name.h"
#include "pipelines/scene/body_kind.h"
#include "pipelines/scene/known_forces.h"
#include "pipelines/scene/scene_stages.h"

namespace pipelines {
namespace {

/// The planetary mill's conventions of the paper leave a resultant, unless they agree with the consistent
/// one.
void refuse_open_balance(const Scene& scene, SceneTable& machine) {
  const auto* mill = std::get_if<kinetics::PlanetaryMill>(&scene.machine);
  if (mill == nullptr || mill->convention == kinetics::PlanetaryConvention::consistent) return;
  if (!scene.masses_from_mesh.empty()) return;
  const auto loads = compute_loads(scene.machine, scene.kinetics_effects(), {1, 360});
  const double force = loads.quantity("closure_force").values.maxCoeff(),
               moment = loads.quantity("closure_moment").values.maxCoeff();
  if (force <= 1e-12 && moment <= 1e-12) return;
  machine.refuse("convention", "leaves " + shown(100 * force, 2) + " % of the forces and " +
                                   shown(100 * moment, 2) +
                                   " % of the moments without a counterpart, which a body in equilibrium "
                                   "needs; write \"consistent\", or remove the bodies for the load stage "
                                   "alone");
}

/// A table's samples need all their turns; what a mill refuses shows in one.
int rehearsal_turns(const Scene& scene) {
  return std::holds_alternative<kinetics::LoadTable>(scene.machine) ? scene.sampling.turns : 1;
}

/// A bearing's load must be one that the load stage gives, or that a body adds.
void check_bearings(const Scene& scene, const kinetics::LoadHistory& loads, SceneTable& root) {
  std::vector<std::string> of_bodies;
  for (const auto& body : scene.bodies) {
    const auto own = kind_of(body).bearing_loads(body);
    of_bodies.insert(of_bodies.end(), own.begin(), own.end());
  }
  if (scene.drum_axes) of_bodies.push_back("trunnions_turning");
  for (const auto& bearing : scene.bearings)
    if (!force_of(bearing.load, loads) && !contains(of_bodies, bearing.load))
      root.refuse("bearings", "the load \"" + bearing.load + "\" of \"" + bearing.name +
                                  "\" is no force here; known are: " + listed(known_forces(loads)) +
                                  (of_bodies.empty() ? "" : ", " + listed(of_bodies)));
}

/// What can be told of a machine before the mesh gives its masses.
/// @throws kinetics::MachineRefused
void check_without_masses(const Scene& scene) {
  if (const auto* train = std::get_if<kinetics::DriveTrain>(&scene.machine))
    kinetics::mean_speed_rad_s(*train, train->inertias.at(0).name);
  if (const auto* mill = std::get_if<kinetics::PlanetaryMill>(&scene.machine))
    kinetics::planetary_geometry(*mill);
}

/// @throws meshes::GeometryRefused as the mesher, without meshing
void check_shape(const BodyScene& body) {
  if (const auto* shaft = body.shaft()) {
    if (shaft->keyways.empty())
      meshes::check_shaft(shaft->geometry);
    else
      meshes::check_solid_shaft(shaft->geometry, shaft->keyways, shaft->solid);
  }
  if (const auto* chamber = std::get_if<ChamberShape>(&body.shape)) {
    const auto& [geometry, control] = *chamber;
    meshes::check_control(control);
    meshes::check_sizes(geometry);
    meshes::check_clearances(geometry, meshes::lay_out(geometry, control));
  }
}

}  // namespace

void rehearse(const Scene& scene, SceneTable& root, SceneTable& machine, std::vector<SceneTable>& bodies) {
  try {
    if (!scene.bodies.empty()) refuse_open_balance(scene, machine);
    if (scene.run_up)
      kinetics::check_run_up(scene.vibratory_mill(), scene.kinetics_effects(), *scene.run_up);
    else if (scene.masses_from_mesh.empty())
      check_bearings(
          scene, compute_loads(scene.machine, scene.kinetics_effects(), {rehearsal_turns(scene), 8}), root);
    else
      check_without_masses(scene);
  } catch (const kinetics::MachineRefused& error) {
    machine.refuse_missing("", "the load stage refuses it: " + std::string(error.what()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) try {
      check_shape(scene.bodies[i]);
    } catch (const meshes::GeometryRefused& error) {
      const std::string remedy = "the mesher refuses it: " + std::string(error.what());
      scene.bodies[i].shaft() ? bodies[i].refuse("contour", remedy) : bodies[i].refuse_missing("", remedy);
    }
}

}  // namespace pipelines
