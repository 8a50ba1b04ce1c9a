#include "pipelines/analysis/body_vibration.h"

namespace pipelines {
namespace {

/// 6 x instants.
Eigen::ArrayXXd stress_over_cycle(const BodyAnalysis& analysis, const StressPoint& point) {
  const auto unit_Pa = unit_stress_at(analysis.responses, point);
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> unit(unit_Pa.front().data(), 6,
                                                                        Eigen::Index(unit_Pa.size()));
  return unit * analysis.loads.history.values.matrix();
}

}  // namespace

void add_vibration(const Scene& scene, const MeshedBody& meshed, const kinetics::LoadHistory& history,
                   BodyAnalysis& analysis, StageClock& clock) {
  if (analysis.scene.natural_frequencies <= 0) return;
  const auto* toe = analysis.hot_spots.empty() ? nullptr : &analysis.hot_spots.front();
  analysis.vibration = clock.run("natural frequencies", [&] {
    return vibration(scene, analysis.scene, meshed, history,
                     stress_over_cycle(analysis, {{{analysis.peak.node, 1}}, analysis.peak.instant}),
                     toe != nullptr ? stress_over_cycle(analysis, stress_point(*toe)) : Eigen::ArrayXXd());
  });
  const auto enter = [](ErrorBudget& errors, const DynamicAmplification& dynamic, double value_Pa) {
    errors.set_model({"quasi_static", "dynamic amplification of the harmonics of the stress",
                      (dynamic.factor - 1) * value_Pa});
  };
  enter(analysis.peak.errors, analysis.vibration->amplification, analysis.peak.value_Pa);
  if (toe != nullptr) enter(analysis.hot_spot_errors, analysis.vibration->at_hot_spot, toe->von_mises_Pa);
}

}  // namespace pipelines
