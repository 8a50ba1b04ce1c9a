/// The load stage and what it hands to the bodies of a scene.
#pragma once

#include <memory>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/base/common/stage_clock.h"
#include "pipelines/loads/channels/bearings.h"
#include "pipelines/loads/channels/load_files.h"
#include "pipelines/loads/stage/body_loads.h"

namespace pipelines {

/// Loads of a machine over the scene's period, or its run-up.
kinetics::LoadHistory load_stage(const Scene& scene, const Machine& machine);

/// The springs of a vibratory mill; empty for other machines.
std::vector<kinetics::Spring> springs_of(const Scene& scene);

/// Meshes all bodies, in the order of Scene::bodies.
std::vector<MeshedBody> mesh_bodies(const Scene& scene);

struct StartUp;  // start_up_loads.h

/// A scene's bodies, meshed and loaded: ready to be solved.
struct Loaded {
  Scene scene;                     ///< with the meshes, instants and harmonics that the loads are of
  std::vector<MeshedBody> meshed;  ///< in the order of Scene::bodies, like body_loads
  MassAgreement masses;
  kinetics::LoadHistory loads;
  std::vector<BodyLoads> body_loads;
  std::vector<BearingResult> bearings;
  std::shared_ptr<const StartUp> start_up;  ///< by load_start_up, where the scene asks for a start; else null

  // Defined in the .cc file: else every file that copies one compiles the copies of all members anew.
  Loaded();
  Loaded(const Loaded&);
  Loaded(Loaded&&) noexcept;
  Loaded& operator=(const Loaded&);
  Loaded& operator=(Loaded&&) noexcept;
  ~Loaded();

  BodyChannels channels() const;
};

/// @param meshed  in the order of scene.bodies
/// @throws SceneError if the scene's effects leave a body without loads or without equilibrium
/// @throws StageRefused if masses of machine and mesh do not agree, supports are missing, or a bearing's load
/// is none of the scene
/// @throws NotFinite
Loaded load_bodies(const Scene& scene, std::vector<MeshedBody> meshed, StageClock& clock);

}  // namespace pipelines
