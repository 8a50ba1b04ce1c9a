#include "pipelines/analysis/body_vibration.h"

namespace pipelines {
namespace {

/// 6 x instants.
Eigen::ArrayXXd stress_over_cycle(const BodyAnalysis& analysis, std::size_t node) {
  const auto n_channels = analysis.responses.channels.size();
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> unit(
      &analysis.responses.stress_Pa[node * n_channels * 6], 6, Eigen::Index(n_channels));
  return unit * analysis.loads.history.values.matrix();
}

}  // namespace

void add_vibration(const Scene& scene, const MeshedBody& meshed, const kinetics::LoadHistory& history,
                   BodyAnalysis& analysis, StageClock& clock) {
  if (analysis.scene.natural_frequencies <= 0) return;
  analysis.vibration = clock.run("natural frequencies", [&] {
    return vibration(scene, analysis.scene, meshed, history, stress_over_cycle(analysis, analysis.peak.node));
  });
  const double more = analysis.vibration->amplification.factor - 1;
  analysis.peak.errors.set_model(
      {"quasi_static", "dynamic amplification of the harmonics of the peak", more * analysis.peak.value_Pa});
}

}  // namespace pipelines
