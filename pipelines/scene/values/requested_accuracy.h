/// How well a run has to know the stresses, and in what time.
#pragma once

namespace pipelines {

/// The tolerances that a scene and the command line may ask for.
constexpr double least_tolerance = 1e-4, largest_tolerance = 0.5;

/// What a run is asked for beside the scene's mesh; neither: that mesh as it is.
struct RequestedAccuracy {
  double tolerance = 0, time_limit_s = 0;
  /// tolerance = "none": solved once, on the mesh that the scene gives; both others are 0 then.
  bool once = false;
  bool by_default = false;  ///< nobody asked: `run` took its own
  bool any() const { return tolerance > 0 || time_limit_s > 0; }
};

/// What `run` does where neither scene nor command line ask for anything: 5 % within a minute, whichever
/// comes first.
inline RequestedAccuracy with_default(RequestedAccuracy accuracy) {
  if (accuracy.once || accuracy.any()) return accuracy;
  accuracy.tolerance = 0.05;
  accuracy.time_limit_s = 60;
  accuracy.by_default = true;
  return accuracy;
}

}  // namespace pipelines
