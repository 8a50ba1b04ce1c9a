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
