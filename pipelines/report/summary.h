/// summary.json: every headline number of a run under keys that stay, and the short table on the terminal.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "kinetics/load_history.h"
#include "pipelines/analysis/body_analysis.h"
#include "pipelines/common/stage_clock.h"
#include "pipelines/loads/bearings.h"
#include "pipelines/scene/scene.h"

namespace pipelines {

struct DutyResult;
struct TorsionReport;

/// What a run has come to; no bodies for the load stage alone.
struct RunReport {
  const Scene& scene;
  const kinetics::LoadHistory& loads;
  const std::vector<BodyAnalysis>& bodies;
  const std::vector<MassFigure>& masses;  ///< of the load stage beside those of the meshes
  const std::vector<StageCost>& costs;
  std::vector<BearingResult> bearings = {};
  const DutyResult* duty = nullptr;  ///< null: the scene has no operating blocks
  const TorsionReport* torsion = nullptr;  ///< of a drive train
};

/// The text of summary.json. Everything but `timing` is the same from run to run.
std::string summary_json(const RunReport& report);

/// What effects = "auto" has switched off, and what that could change at most; nothing for other scenes.
/// @param bodies  solved; none: nothing is known of stresses
void print_effect_choice(std::ostream& out, const Scene& scene, const std::vector<BodyAnalysis>& bodies);

/// The table for a person: loads, peak stress with place and moment, zones, torsion, seconds per stage.
void print_report(std::ostream& out, const RunReport& report);

}  // namespace pipelines
