#include "pipelines/write/fields/run_fields.h"

#include <cmath>

#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/write/fields/zone_fields.h"

namespace pipelines {

using summary::Json, summary::number;

FieldTable<SearchStep> search_step_fields() {
  using Field = FieldOf<SearchStep>;
  return without_csv(FieldTable<SearchStep>{
      {"instants_per_turn", quantities::count, "of the loads", &SearchStep::instants_per_turn},
      {"pressure_harmonics", quantities::count, "around a seat", &SearchStep::pressure_harmonics},
      {"dofs", quantities::count, "of the mesh", "unknowns", &SearchStep::n_dofs},
      Field("value", quantities::stress, "the stress that the tolerance refers to", "stress MPa",
            &SearchStep::value_Pa)
          .shown_as([](const Json& row) {
            const auto& error = row.at("error").at("total");
            return with_error(row.at("value_Pa").get<double>(),
                              error.is_number() ? error.get<double>() : INFINITY);
          }),
      {"error", quantities::structure, "of it, by its sources",
       [](const SearchStep& s) { return budget_json(s.errors); }},
      Field("seconds", quantities::time, "of the step, on the terminal alone", "took", &SearchStep::seconds)
          .without_summary()
          .optional(),
      {"dominated_by", quantities::text, "largest source that a finer run lowers", "dominated by",
       [](const SearchStep& s) { return s.errors.largest_reducible(); }},
      {"mesh", quantities::text, "its fineness in words", "mesh", &SearchStep::fineness},
  });
}

FieldTable<NaturalFrequency> natural_frequency_fields() {
  using Field = FieldOf<NaturalFrequency>;
  return without_csv(FieldTable<NaturalFrequency>{
      {"value", quantities::frequency, "of the mesh", "natural frequency", &NaturalFrequency::value_Hz},
      {"unit", quantities::text, "of both", [](const auto&) { return "Hz"; }},
      Field("error", quantities::frequency, "by which it may be lower, for want of a finer mesh",
            "lower by at most", &NaturalFrequency::error_Hz)
          .digits("{:.2g}"),
  });
}

FieldTable<CriticalSpeed> critical_speed_fields() {
  using Field = FieldOf<CriticalSpeed>;
  const auto share = [](const CriticalSpeed& s) {
    return s.share > 0 ? summary::number(s.share) : summary::Json();
  };
  return without_csv(FieldTable<CriticalSpeed>{
      Field("order", quantities::ratio,
            "turns of the load in space per turn of the shaft; negative: backward", "order",
            &CriticalSpeed::order)
          .digits("{:.4g}"),
      {"mode", quantities::count, "from the slowest that this order meets", "mode",
       [](const auto& s) { return s.mode; }},
      {"speed", quantities::turning_speed, "critical speed of the shaft", "critical speed",
       &CriticalSpeed::speed_rad_s},
      Field("error", quantities::turning_speed, "by which it may be lower, for want of shorter elements",
            "lower by at most", &CriticalSpeed::error_rad_s)
          .digits("{:.2g}"),
      {"margin", quantities::percent, "by which the operating speed is above it, over it", "margin",
       &CriticalSpeed::margin},
      {"whirl", quantities::turning_frequency, "frequency of that whirl at the operating speed", "whirl now",
       &CriticalSpeed::whirl_rad_s},
      Field("share", quantities::percent, "of the load, of the largest force on the shaft", "of the forces",
            share)
          .optional(),
  });
}

FieldTable<StageCost> stage_fields() {
  using Field = FieldOf<StageCost>;
  return without_csv(FieldTable<StageCost>{
      Field("stage", quantities::text, "its key", "stage", &StageCost::stage).without_summary().optional(),
      {"seconds", quantities::ratio, "of wall time", "seconds", &StageCost::seconds},
      {"peak_memory_gigabytes", quantities::ratio, "resident, largest so far", "largest memory so far, GB",
       &StageCost::peak_gigabytes},
  });
}

}  // namespace pipelines
