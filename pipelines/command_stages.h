/// Stages that several commands begin with.
#pragma once

#include <memory>
#include <vector>

#include "fem/model.h"
#include "kinetics/load_history.h"
#include "pipelines/atomic_file.h"
#include "pipelines/body_mesh.h"
#include "pipelines/scene.h"

namespace pipelines {

/// The load history of the scene, or its run-up.
/// @param machine  of the scene, with the masses that a mesh has told
kinetics::LoadHistory load_stage(const Scene& scene, const Machine& machine);

/// MPI takes half a second and may talk: only where a body is looked at.
struct Solver {
  explicit Solver(int n_threads) : environment(argc, argv, n_threads) {}
  char name[11] = "millstress";
  char* arguments[2] = {name, nullptr};
  char** argv = arguments;
  int argc = 1;
  fem::Environment environment;
};

/// Meshes all bodies, each to a temporary name beside its place.
std::vector<MeshedBody> mesh_bodies(const Scene& scene,
                                    const std::vector<std::unique_ptr<AtomicFile>>& files);

}  // namespace pipelines
