/// The machine of a scene with what its bodies' meshes say about it.
#pragma once

#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// The scene's machine, with the masses that it leaves to a mesh. Meshes are made only where there are such
/// masses, and thrown away.
/// @throws as agree_masses, and as meshing a body does
Machine machine_with_masses(const Scene& scene);

}  // namespace pipelines
