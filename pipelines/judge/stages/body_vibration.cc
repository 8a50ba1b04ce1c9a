#include "pipelines/judge/stages/body_vibration.h"

namespace pipelines {
namespace {

/// @param name  of a feature or of a weld toe
ShakenPlace shaken(const Responded& analysis, const std::string& name, double value_Pa,
                   const StressPoint& point) {
  const auto unit_Pa = unit_stress_at(analysis.responses, point);
  return {name, value_Pa,
          Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>(unit_Pa.front().data(), 6,
                                                                     Eigen::Index(unit_Pa.size()))};
}

}  // namespace

void add_vibration(const Scene& scene, const MeshedBody& meshed, const kinetics::LoadHistory& history,
                   Judged& analysis, StageClock& clock) {
  if (analysis.scene.natural_frequencies <= 0) return;
  analysis.vibration = clock.run("natural frequencies", [&] {
    std::vector<ShakenPlace> places{shaken(analysis, analysis.peak.feature, analysis.peak.value_Pa,
                                           {{{analysis.peak.node, 1}}, analysis.peak.instant})},
        toes;
    const auto& maximum = analysis.envelope.von_mises;
    for (const auto& place : largest_by_feature(analysis.responses.nodes, maximum.value_Pa,
                                                analysis.mesh.features, analysis.places))
      places.push_back(
          shaken(analysis, place.feature, place.value_Pa, {{{place.node, 1}}, maximum.instant[place.node]}));
    for (const auto& toe : analysis.hot_spots)
      toes.push_back(shaken(analysis, toe.name, toe.von_mises_Pa, stress_point(toe)));
    return vibration(scene, analysis.scene, meshed, history, analysis.loads.history, places, toes);
  });
  enter_vibration(analysis);
}

void enter_vibration(Judged& analysis) {
  if (!analysis.vibration) return;
  const auto enter = [](ErrorBudget& errors, const Vibration::Added& added, double value_Pa) {
    errors.set_model({"quasi_static",
                      "dynamic amplification of the harmonics of the stress" +
                          (added.place.empty() ? "" : ", at another place: " + added.place),
                      added.share * value_Pa});
  };
  enter(analysis.peak.errors, analysis.vibration->to_peak, analysis.peak.value_Pa);
  if (!analysis.hot_spots.empty())
    enter(analysis.hot_spot_errors, analysis.vibration->to_hot_spot, analysis.hot_spots.front().von_mises_Pa);
}

void add_critical_speeds(const Scene& scene, const MeshedBody& meshed, const kinetics::LoadHistory& history,
                         Judged& analysis, StageClock& clock) {
  if (analysis.scene.critical_speeds <= 0) return;
  std::optional<double> solid_Hz;
  if (analysis.vibration) solid_Hz = analysis.vibration->natural_frequencies.front().value_Hz;
  analysis.critical_speeds = clock.run("critical speeds", [&] {
    return critical_speeds(scene, analysis.scene, meshed, history, analysis.loads.history, solid_Hz);
  });
}

}  // namespace pipelines
