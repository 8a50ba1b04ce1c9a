#include "pipelines/command_stages.h"

#include <utility>

#include "kinetics/run_up.h"

namespace pipelines {
namespace {

/// What a trunnion that turns with the drum feels: constant loads of the carrier's frame reverse fully.
void add_turning_trunnions(kinetics::LoadHistory& loads) {
  auto turning = kinetics::turned_with_drum(loads, loads.resultant("trunnions"));
  turning.role = "trunnions_turning";
  turning.description = "the same load in axes that turn with the drum";
  loads.resultants.push_back(std::move(turning));
}

std::vector<kinetics::Spring> springs_of(const Scene& scene) {
  const auto* mill = std::get_if<kinetics::VibratoryMill>(&scene.machine);
  return mill ? mill->springs : std::vector<kinetics::Spring>{};
}

}  // namespace

kinetics::LoadHistory load_stage(const Scene& scene, const Machine& machine) {
  if (scene.run_up)
    return kinetics::compute_run_up(scene.vibratory_mill(), scene.kinetics_effects(), *scene.run_up);
  auto loads = compute_loads(machine, scene.kinetics_effects(), scene.sampling);
  if (scene.drum_axes) add_turning_trunnions(loads);
  return loads;
}

std::vector<MeshedBody> mesh_bodies(const Scene& scene,
                                    const std::vector<std::unique_ptr<AtomicFile>>& files) {
  std::vector<MeshedBody> bodies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    bodies.push_back(mesh_body(scene.bodies[i], files[i]->temporary(), springs_of(scene)));
  return bodies;
}

}  // namespace pipelines
