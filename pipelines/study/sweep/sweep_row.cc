#include "pipelines/study/sweep/sweep_row.h"

#include <cmath>

#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/write/fields/bearing_fields.h"

namespace pipelines {
namespace {

/// Fields of a result that are figures, or numbers without a unit of their own, as "<kind><name>.<key>".
/// @param unit  of such numbers
template <typename Row>
void add_numbers(SweepFigures& figures, std::string_view kind, std::string_view name,
                 const FieldTable<Row>& fields, const Row& of, const std::string& unit = "") {
  for (const auto& field : fields) {
    if (field.quantity.shape == Shape::text || field.quantity.shape == Shape::unit) continue;
    const bool has_unit = *field.quantity.unit != '\0';
    const auto value = field.value(of);
    if (value.is_object())
      figures.add({kind, name, ".", field.key}, value.at("unit").template get_ref<const std::string&>(),
                  value.at("value").template get<double>());
    else if (value.is_number() && !has_unit)
      figures.add({kind, name, ".", field.key}, unit, value.template get<double>());
  }
}

}  // namespace

void add_load_figures(SweepRow& row, const Scene& scene, const kinetics::LoadHistory& loads,
                      const std::vector<BearingResult>& bearings) {
  static const auto of_loads = load_fields();
  static const auto of_bearings = joined(bearing_fields(), bearing_answer_fields());
  for (const auto& figure : load_figures(scene, loads))
    add_numbers(row.figures, "loads.", figure.name, of_loads, figure, figure.unit);
  int mode = 0;
  for (const double w : kind_of(scene.machine).natural_frequencies_rad_s(scene.machine))
    row.figures.add({"torsion.natural_frequency_", std::to_string(++mode)}, "rad/s", w);
  for (const auto& bearing : bearings)
    add_numbers(row.figures, "bearings.", bearing.name, of_bearings, bearing);
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
  add(".mass", "kg", analysis.masses.mass_kg);
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
