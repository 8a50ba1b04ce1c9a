/// From loads on a mesh to the stress of a body over the cycle: respond and superpose.
#pragma once

#include "pipelines/judge/analysis/body_analysis.h"

namespace pipelines {

/// Solves and superposes. Finds no zones (superpose_body.h) and writes no results.
/// @throws fem::SolveFailed if the solve fails, LoadsDoNotClose if the loads do not close to 1e-9 on the mesh
BodyAnalysis analyse_body(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads,
                          const RunOptions& options, StageClock& clock);

}  // namespace pipelines
