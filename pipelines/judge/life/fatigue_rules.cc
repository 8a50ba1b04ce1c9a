#include "pipelines/judge/life/fatigue_rules.h"

#include <algorithm>

namespace pipelines {

CyclicStress scalar(const StressCycle& cycle) {
  return {cycle.amplitude_Pa, cycle.signed_mean_Pa};
}

CyclicStress scalar(const NodalCycle& cycle) {
  return {cycle.amplitude_Pa, cycle.signed_mean_Pa};
}

FatigueRules::FatigueRules(const FatigueScene& scene)
    : scene_(scene),
      factor_(reliability_factor_of_97_5(scene.reliability) *
              (scene.endurance_Pa ? *scene.endurance_Pa / reversed_strength_Pa(scene.material) : 1.0)) {}

EnduranceLimit FatigueRules::limit(double gradient_per_m, const CyclicStress& stress) const {
  SurfaceState surface;
  surface.roughness_m = scene_.roughness_m;
  surface.treatment_factor = scene_.treatment;
  auto limit =
      endurance_limit(scene_.material, StressKind::normal, gradient_per_m, surface, stress, scene_.safety);
  limit.reversed_Pa *= factor_;
  limit.amplitude_Pa *= factor_;
  limit.utilisation /= factor_;
  return limit;
}

std::vector<StressBlock> FatigueRules::counted(const std::vector<EndsOfCycle>& cycles,
                                               const EnduranceLimit& limit) const {
  std::vector<StressBlock> blocks;
  blocks.reserve(cycles.size());
  for (const auto& cycle : cycles) {
    const double mean_Pa = cycle_between(cycle.from, cycle.to, 0, 1).signed_mean_Pa;
    const double amplitude_Pa =
        equivalent_reversed_amplitude_Pa({cycle.range_Pa / 2, mean_Pa}, limit.mean_stress_sensitivity);
    blocks.push_back({amplitude_Pa / limit.reversed_Pa, 1});
  }
  return blocks;
}

SnCurve FatigueRules::design_curve(const std::vector<StressBlock>& blocks) const {
  SnCurve curve{1 / scene_.safety, group().knee_cycles, group().slope, group().second_slope};
  const bool above = std::any_of(blocks.begin(), blocks.end(), [&](const auto& block) {
    return block.amplitude_Pa > curve.knee_amplitude_Pa;
  });
  curve.endures_together = !curve.second_slope;
  if (above && curve.endures_together) curve.second_slope = curve.slope;
  return curve;
}

}  // namespace pipelines
