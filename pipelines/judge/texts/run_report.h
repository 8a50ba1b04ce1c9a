/// What a run has come to: what summary.json, the table on the terminal and report.html are made of.
#pragma once

#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/base/common/stage_clock.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/loads/channels/bearings.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

struct DutyResult;
struct TorsionReport;

/// What a run has come to; no bodies for the load stage alone.
struct RunReport {
  const Scene& scene;
  const kinetics::LoadHistory& loads;
  const std::vector<Judged>& bodies;
  const std::vector<MassFigure>& masses;  ///< masses of the load stage beside those of the meshes
  const std::vector<StageCost>& costs;
  std::vector<BearingResult> bearings = {};
  const DutyResult* duty = nullptr;        ///< null: the scene has no operating blocks
  const TorsionReport* torsion = nullptr;  ///< torsion of a drive train; null for other machines
};

}  // namespace pipelines
