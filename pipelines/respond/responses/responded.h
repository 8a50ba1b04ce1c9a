/// What the stage `respond` knows of a body: its mesh, its loads, and the unit responses to them.
#pragma once

#include <string>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/loads/stage/body_loads.h"
#include "pipelines/scene/values/method.h"

namespace pipelines {

/// What the work on a body may use.
struct RunOptions {
  int n_threads = 0;         ///< 0: all cores
  bool fresh = false;        ///< do not reuse unit responses of an earlier run
  bool keep_factor = false;  ///< a search refines locally: for its goals, and instead of submodels
};

struct Responded {
  BodyScene scene;
  Method method = Method::solid;  ///< the model that the responses are of
  meshes::BodyMesh mesh;
  std::vector<RegionMass> regions;  ///< of the mesh
  fem::MassProperties masses;
  fem::GeometryError geometry_error;
  BodyLoads loads;
  fem::UnitResponses responses;
  bool responses_reused = false;      ///< taken from an earlier run
  std::vector<std::string> warnings;  ///< of damaged files that an earlier run has left
  double solve_s = 0;                 ///< wall time; 0: taken from before
};

/// A body with unit responses that a model has found.
Responded responded(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads,
                    fem::UnitResponses responses);

}  // namespace pipelines
