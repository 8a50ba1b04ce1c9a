#include "pipelines/study/accuracy/accuracy_report.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <ostream>
#include <thread>

#include "pipelines/base/common/version.h"
#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/base/files/hdf5_file.h"

namespace pipelines {
namespace {

using summary::Json, summary::number_or_none;

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

double machine_gigabytes() {
  return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE)) / 1e9;
}

/// "reference", "chosen", "contradicted", "frontier" or nothing.
std::string mark_of(const StudyRow& r) {
  if (r.run.is_reference) return "reference";
  if (r.study.chosen && &r.study.rows[*r.study.chosen] == &r.run) return "chosen";
  if (r.run.is_contradicted) return "contradicted";
  return r.run.on_frontier ? "frontier" : "";
}

Json errors_json(const StudyRow& r) {
  auto json = Json::object();
  for (const auto* entries : {&r.run.errors.numerical, &r.run.errors.model})
    for (const auto& entry : *entries) json[entry.source] = number_or_none(r.run.errors.of(entry.source));
  return json;
}

Json stages_json(const StudyRow& r) {
  auto json = Json::object();
  for (const auto& stage : r.run.stages) json[stage.stage] = seconds_of(r.run.stages, stage.stage);
  return json;
}

std::vector<StudyRow> rows_of(const AccuracyStudy& study) {
  std::vector<StudyRow> rows;
  for (const auto& run : study.rows) rows.push_back({study, run});
  return rows;
}

/// In SI; of shares a series each.
void write_series(Hdf5Writer& writer, const std::string& group, const Field& field, const Json& rows) {
  for (const auto& column : csv_columns({field}, rows)) {
    const auto name = group + "/" + column.name, part = column.name.substr(field.column.size());
    if (field.quantity.shape == Shape::text) {
      writer.write(name, std::get<std::vector<std::string>>(column.cells));
      continue;
    }
    std::vector<double> values;
    for (const auto& row : rows) {
      const auto& value = value_of(row, field);
      const auto number = value.is_object() ? value.value(part, Json(0.0)) : value;
      values.push_back(number.is_number() ? number.get<double>() : std::numeric_limits<double>::quiet_NaN());
    }
    writer.write(name, values, {field.quantity.one == 1 ? field.quantity.unit : std::string("Pa"), ""});
  }
}

}  // namespace

FieldTable<StudyRow> accuracy_fields() {
  using Field = FieldOf<StudyRow>;
  const auto number_of = [](auto of) { return [=](const StudyRow& r) { return number_or_none(of(r.run)); }; };
  const auto share_of_reference = [](const char* key) {
    return [=](const Json& row) {
      const double reference_Pa = row.at("reference_Pa").get<double>();
      return fmt::format("{:.2f}%", reference_Pa > 0 ? 100 * row.at(key).get<double>() / reference_Pa : 0);
    };
  };
  constexpr Quantity gigabytes{Shape::number, "", "GB", 1, "{:.2g}"};
  constexpr Quantity stress_by_name{Shape::shares, "", "MPa", 1e6, "{:.2f}"};
  constexpr Quantity seconds_by_name{Shape::shares, "", "s", 1, "{:.3g}"};
  return {
      {"model", quantities::text, "as `accuracy` calls it", "model",
       [](const auto& r) { return r.run.model; }},
      {"mark", quantities::text, "`reference`, `chosen`, `contradicted` or `frontier`", "mark", mark_of},
      {"instants_per_turn", quantities::count, "of the loads",
       [](const auto& r) { return r.run.instants_per_turn; }},
      {"unknowns", quantities::count, "of the mesh", "unknowns", [](const auto& r) { return r.run.n_dofs; }},
      Field("value", quantities::stress, "governing stress", "stress",
            number_of([](const auto& run) { return run.value_Pa; }))
          .digits("{:.2f}"),
      {"largest_principal_stress", quantities::stress, "outside the exclusion distances",
       number_of([](const auto& run) { return run.principal_Pa; })},
      {"reference", quantities::stress, "what runs are compared with",
       [](const auto& r) { return r.study.reference_Pa; }},
      Field("error_estimated", quantities::stress, "by the run's own budget; people read its share",
            "estimate", number_of([](const auto& run) { return run.errors.total_Pa(); }))
          .shown_as(share_of_reference("error_estimated_Pa")),
      Field("error_true", quantities::stress, "distance from the reference; people read its share", "true",
            number_of([](const auto& run) { return run.true_error_Pa; }))
          .shown_as(share_of_reference("error_true_Pa")),
      {"effectivity", quantities::ratio, "estimated over true error; empty: the run meets the reference",
       number_of([](const auto& run) { return effectivity(run); })},
      Field("seconds", quantities::time, "mean over the repeats", "took",
            number_of([](const auto& run) { return run.seconds; }))
          .digits("{:.3g}"),
      Field("seconds_spread", quantities::time, "range over the repeats", "spread",
            number_of([](const auto& run) { return run.spread_s; }))
          .digits("{:.2g}"),
      {"memory", gigabytes, "largest during the run", "memory",
       number_of([](const auto& run) { return run.gigabytes; })},
      {"mesh", quantities::text, "in words", "mesh", [](const auto& r) { return r.run.fineness; }},
      Field("error", stress_by_name, "by source", errors_json).in_column("error."),
      Field("seconds_by_stage", seconds_by_name, "by stage", stages_json).in_column("seconds."),
  };
}

std::string machine_and_versions() {
  return fmt::format("{}, {} threads, {:.0f} GB; millstress {}, {}", processor(),
                     std::thread::hardware_concurrency(), machine_gigabytes(), version, MILLSTRESS_LIBRARIES);
}

Effectivities effectivities(const AccuracyStudy& study) {
  Effectivities result;
  std::vector<double> all;
  for (const auto& row : study.rows) {
    if (row.is_reference) continue;
    ++result.n_runs;
    const double uncertain_Pa = study.reference_error_Pa;
    if (row.errors.total_Pa() + uncertain_Pa >= row.true_error_Pa) ++result.n_bounded;
    all.push_back(effectivity(row));
  }
  if (all.empty()) return result;
  std::sort(all.begin(), all.end());
  result.smallest = all.front();
  result.median = all[all.size() / 2];
  return result;
}

/// Tells where `run --tolerance` ends: the first step of the refined mesh whose own estimate is within it.
std::string where_tolerances_end(const AccuracyStudy& study) {
  std::string text;
  for (const double tolerance : {0.05, 0.02, 0.01}) {
    const auto row = std::find_if(study.rows.begin(), study.rows.end(), [&](const auto& r) {
      return r.model == "refined mesh" && r.errors.numerical_Pa() <= tolerance * r.value_Pa;
    });
    text += row == study.rows.end()
                ? fmt::format("    {:g} %: not reached\n", 100 * tolerance)
                : fmt::format("    {:g} %: {:.2f} MPa after {:.3g} s, {:.2f} % from the reference\n",
                              100 * tolerance, row->value_Pa / 1e6, row->seconds,
                              100 * row->true_error_Pa / study.reference_Pa);
  }
  return text;
}

std::string disagreements(const AccuracyStudy& study) {
  std::string text;
  for (const auto& row : study.rows)
    if (row.is_contradicted)
      text += fmt::format("    {} ({}, {} unknowns): {:.2f} +- {:.2f} MPa\n", row.model, row.fineness,
                          row.n_dofs, row.value_Pa / 1e6, row.errors.total_Pa() / 1e6);
  if (text.empty()) return text;
  return fmt::format(
             "  ! WARNING: these disagree with the reference, {:.2f} +- {:.2f} MPa, by more than both "
             "state:\n",
             study.reference_Pa / 1e6, study.reference_error_Pa / 1e6) +
         text +
         "    One of each pair is wrong. Look at where the two have their largest stress before you use "
         "either.\n";
}

void print_accuracy(std::ostream& out, const AccuracyStudy& study) {
  out << fmt::format("\n{}: {}, what accuracy costs\n  {}\n  reference {:.2f} MPa ({}", study.body,
                     study.quantity, machine_and_versions(), study.reference_Pa / 1e6, study.reference);
  out << (study.reference_error_Pa > 0
              ? fmt::format("; its own estimate {:.2f} MPa)\n", study.reference_error_Pa / 1e6)
              : ")\n");
  print_list(out, accuracy_fields(), rows_of(study));
  for (const auto& model : study.left_out)
    out << fmt::format("    {:<15} left out: {}\n", model.model, model.why);
  const auto e = effectivities(study);
  out << fmt::format(
             "\n  chosen: cheapest within {:g} % by its own estimate; frontier: no cheaper run is closer\n",
             100 * study.tolerance)
      << "  " << study.next_factor_of_two << "\n  run --tolerance ends with\n"
      << where_tolerances_end(study)
      << fmt::format(
             "  estimates bound the true error in {} of {} runs; median of estimate over true error {:.2g}\n",
             e.n_bounded, e.n_runs, e.median);
  out << disagreements(study);
  if (study.grid) print_grid_study(out, *study.grid);
  if (!study.effects.empty()) print_effect_prices(out, study.body, study.effects);
}

void write_accuracy_csv(const std::filesystem::path& file, const AccuracyStudy& study) {
  write_csv(file, csv_columns(fields_of(accuracy_fields()), whole_rows(accuracy_fields(), rows_of(study))));
}

void write_accuracy_h5(const std::filesystem::path& file, const std::vector<AccuracyStudy>& studies) {
  AtomicFile atomic(file);
  Hdf5Writer writer(atomic.temporary());
  writer.attribute("/", "machine", machine_and_versions());
  for (const auto& study : studies) {
    const std::string group = "/" + study.body;
    writer.make_group(group);
    writer.attribute(group, "quantity", study.quantity);
    writer.attribute(group, "reference", study.reference);
    writer.attribute(group, "reference_Pa", study.reference_Pa);
    writer.attribute(group, "reference_error_Pa", study.reference_error_Pa);
    writer.attribute(group, "tolerance", study.tolerance);
    writer.attribute(group, "next_factor_of_two", study.next_factor_of_two);
    if (!study.left_out.empty()) {
      std::string text;
      for (const auto& model : study.left_out)
        text += (text.empty() ? "" : "\n") + model.model + ": " + model.why;
      writer.attribute(group, "left_out", text);
    }
    if (study.grid) {
      const auto& c = study.grid->convergence;
      writer.attribute(group, "grid_convergence_order", c.observed_order);
      writer.attribute(group, "grid_convergence_extrapolated_Pa", c.extrapolated);
      writer.attribute(group, "grid_convergence_index_Pa", study.grid->index_Pa());
      writer.attribute(group, "grid_convergence_between_nodes_Pa", study.grid->between_nodes_Pa);
      writer.attribute(group, "grid_convergence_refusal", c.refusal);
    }
    const auto rows = whole_rows(accuracy_fields(), rows_of(study));
    for (const auto& field : accuracy_fields()) write_series(writer, group, field, rows);
  }
  writer.close();
  atomic.commit();
}

}  // namespace pipelines
