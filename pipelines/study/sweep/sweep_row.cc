#include "pipelines/study/sweep/sweep_row.h"

#include <cmath>

#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {

void add_load_figures(SweepRow& row, const Scene& scene, const kinetics::LoadHistory& loads,
                      const std::vector<BearingResult>& bearings) {
  const MachineKind& kind = kind_of(scene.machine);
  for (const auto& of : load_figures(scene, loads)) {
    const auto add = [&](const char* what, double value) {
      row.figures.add({"loads.", of.name, what}, of.unit, value);
    };
    add(".max", of.statistics.max);
    add(".min", of.statistics.min);
    add(".mean", of.statistics.mean);
    add(".rms", of.statistics.rms);
    add(".first", of.first);
  }
  int mode = 0;
  for (const double w : kind.natural_frequencies_rad_s(scene.machine))
    row.figures.add({"torsion.natural_frequency_", std::to_string(++mode)}, "rad/s", w);
  for (const auto& bearing : bearings) {
    const auto add = [&](const char* figure, const char* unit, const std::optional<double>& value) {
      if (value) row.figures.add({"bearings.", bearing.name, figure}, unit, *value);
    };
    add(".equivalent_load", "N", bearing.equivalent_load_N);
    add(".largest_load", "N", bearing.largest_load_N);
    if (bearing.life) add(".L10h", "h", bearing.life->hours);
    add(".modified_life", "h", bearing.answers.modified_life_h);
    add(".required_rating", "N", bearing.answers.required_rating_N);
    add(".static_safety", "", bearing.answers.static_safety);
  }
  if (const auto n = scene.warnings.size() + loads.warnings.size(); n > 0)
    row.figures.add({"loads", ".warnings"}, "", double(n));
}

void add_body_figures(SweepRow& row, const Judged& analysis, const std::optional<LargestTorsion>& torsion) {
  const std::string body = "bodies." + analysis.scene.name;
  const auto stress = governing_stress(analysis);
  const auto add = [&](const std::string& name, const std::string& unit, double value) {
    row.figures.add({body, name}, unit, value);
  };
  add(".governing", "Pa", stress.value_Pa);
  add(".governing.error", "Pa", stress.errors.reducible_Pa());  // a cheap model's own error too
  add(".governing.safety", "", stress.safety);
  add(".governing.instant", "", stress.instant);
  add(".peak_von_mises", "Pa", analysis.peak.value_Pa);
  if (!analysis.hot_spots.empty()) add(".hot_spot", "Pa", analysis.hot_spots.front().von_mises_Pa);
  if (torsion) {
    add(".torsion.max_shear_stress", "Pa", torsion->value_Pa);
    if (std::isfinite(torsion->error_Pa)) add(".torsion.max_shear_stress.error", "Pa", torsion->error_Pa);
  }
  for (const auto& place : analysis.place_stresses) {
    add(".places." + place.feature, "Pa", place.value_Pa);
    add(".places." + place.feature + ".error", "Pa", error_Pa(analysis, place));
  }
  add(".closure.force", "", analysis.closure.worst_force());
  add(".closure.moment", "", analysis.closure.worst_moment());
  for (auto& zone : swept_zones(analysis)) row.zones.push_back(std::move(zone));
  row.texts.emplace_back(body + ".governing.place", stress.place);
  row.texts.emplace_back(body + ".governing.kind",
                         stress.kind == GoverningStress::Kind::hot_spot ? "hot_spot" : "peak_von_mises");
}

}  // namespace pipelines
