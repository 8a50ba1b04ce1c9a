/// The rules of fatigue with the factors of one body's scene (pipelines/base/fatigue).
#pragma once

#include <vector>

#include "pipelines/base/fatigue/endurance.h"
#include "pipelines/base/fatigue/sn_curve.h"
#include "pipelines/scene/values/fatigue_scene.h"
#include "pipelines/superpose/between_instants/stress_course.h"
#include "pipelines/superpose/envelope/nodal_cycles.h"

namespace pipelines {

/// Amplitude and signed mean of a cycle.
CyclicStress scalar(const StressCycle& cycle);
CyclicStress scalar(const NodalCycle& cycle);

class FatigueRules {
public:
  /// @param scene  outlives this
  explicit FatigueRules(const FatigueScene& scene);

  /// What is endured where the amplitude has that related gradient.
  EnduranceLimit limit(double gradient_per_m, const CyclicStress& stress) const;

  /// The least that any mean leaves of the endurance limit, over that without mean: field IV of the diagram.
  double least_mean_stress_factor() const { return limit(0, {0, 1}).amplitude_Pa / limit(0, {}).reversed_Pa; }

  /// Counted cycles as amplitudes at R = -1, shares of what is endured there. Each has the mean of its own
  /// tensors, at both its ends: stress across the direction of counting opens cracks too.
  std::vector<StressBlock> counted(const std::vector<EndsOfCycle>& cycles, const EnduranceLimit& limit) const;

  /// S-N curve of such shares at the design limit. Where one amplitude is above the knee, those below it
  /// count by the same slope (Miner's elementary rule): damage lowers the limit.
  SnCurve design_curve(const std::vector<StressBlock>& blocks) const;

  const FatigueScene& scene() const { return scene_; }
  const GroupConstants& group() const { return constants_of(scene_.material.group); }

private:
  const FatigueScene& scene_;
  double factor_;  ///< on endurance limits: reliability, a measured limit
};

}  // namespace pipelines
