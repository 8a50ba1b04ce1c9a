/// What a sweep keeps of one point: headline figures by name.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/loads/channels/bearings.h"
#include "pipelines/study/sweep/swept_zones.h"
#include "pipelines/study/variations/sweep_figures.h"

namespace pipelines {

struct SweepRow {
  std::string refused;  ///< why the point could not be computed; empty: it was
  SweepFigures figures;
  std::vector<std::pair<std::string, std::string>> texts;  ///< "bodies.shaft.governing.place" and the like
  std::vector<SweptZone> zones = {};                       ///< zones of all bodies, where they are asked for

  /// NaN if there is none.
  double figure(const std::string& name) const { return figures.value(name); }
};

/// "loads.<name>.max", ".min", ".mean", ".rms" of every load (for_each_load), and ".first" at the first
/// instant; natural frequencies of a drive train; bearings' equivalent loads and lives.
/// @param scene  with the masses that it left to a mesh
void add_load_figures(SweepRow& row, const Scene& scene, const kinetics::LoadHistory& loads,
                      const std::vector<BearingResult>& bearings);

/// "bodies.<name>": governing stress with its errors, safety, place, instant; mass; peak, hot spot; the
/// largest stress of every place that may govern; closure; zones where the analysis has them.
/// @param torsion  largest torsional stress of a shaft, where it has one; its error where that is finite
void add_body_figures(SweepRow& row, const Judged& analysis, const std::optional<LargestTorsion>& torsion);

}  // namespace pipelines
