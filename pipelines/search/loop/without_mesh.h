/// The search of a body by harmonics or as a beam: no mesh is refined, but loads may be resolved better.
#pragma once

#include <functional>
#include <vector>

#include "pipelines/judge/analysis/body_analysis.h"

namespace pipelines {

/// The run that the body is part of.
struct RunOfBody {
  const Scene& scene;
  std::function<void(Scene)> take;  ///< another version of it: loads all bodies anew
  std::function<BodyAnalysis()> analyse;
  std::function<double()> seconds;  ///< since the run began
};

/// While instants or pressure harmonics alone hold the tolerance back, anew with more of them.
/// @param tolerance  of the largest stress, relative; 0: once
/// @param end_s      when the time is up; 0: never
BodyAnalysis search_without_mesh(const RunOfBody& run, std::size_t i_body, double tolerance, double end_s);

/// Puts steps before those of a search.
void prepend_steps(std::vector<SearchStep> before, Search& search);

}  // namespace pipelines
