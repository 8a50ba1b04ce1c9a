#include "pipelines/command/options/scene_machine.h"

#include "fem/models/solid/model.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/loads/stage/machine_masses.h"

namespace pipelines {

Machine machine_with_masses(const Scene& scene) {
  if (scene.masses_from_mesh.empty()) return scene.machine;
  const fem::Environment environment(all_cores);
  return agree_masses(scene, mesh_bodies(scene)).machine;
}

}  // namespace pipelines
