/// The loads of a scene's bodies, whatever their kind.
#pragma once

#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/closure.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/loads/stage/machine_masses.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// What distribution needs to know of a meshed body.
LoadedBody loaded_body(const BodyScene& scene, const MeshedBody& meshed);

/// The loads of one body of a scene, as its kind takes them.
/// @param history  loads of the load stage with the machine of `masses`
BodyLoads distribute_body(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                          const LoadedBody& loaded, const MassAgreement& masses);

/// Whether channels and ports close, before anything is solved: by the resultants that they must have.
/// @throws LoadsDoNotClose if forces or moments miss 1e-9 of their scale
void require_closed_loads(const BodyLoads& loads, const std::vector<RegionMass>& regions);

/// @throws LoadsDoNotClose if the loads miss Closure::limit of their scale
void require_closure(const std::string& body, const Closure& closure);

}  // namespace pipelines
