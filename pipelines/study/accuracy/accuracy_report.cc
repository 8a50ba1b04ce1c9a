#include "pipelines/study/accuracy/accuracy_report.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <ostream>
#include <thread>

#include "pipelines/base/common/version.h"
#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/base/files/hdf5_file.h"

namespace pipelines {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

double machine_gigabytes() {
  return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE)) / 1e9;
}

/// Names of all entries, in the order of their first appearance.
template <typename Names>
std::vector<std::string> union_of(const std::vector<AccuracyRow>& rows, Names&& names_of) {
  std::vector<std::string> result;
  for (const auto& row : rows)
    for (const auto& name : names_of(row))
      if (std::find(result.begin(), result.end(), name) == result.end()) result.push_back(name);
  return result;
}

std::vector<std::string> sources(const std::vector<AccuracyRow>& rows) {
  return union_of(rows, [](const auto& row) {
    std::vector<std::string> names;
    for (const auto* entries : {&row.errors.numerical, &row.errors.model})
      for (const auto& entry : *entries) names.push_back(entry.source);
    return names;
  });
}

std::vector<std::string> stages(const std::vector<AccuracyRow>& rows) {
  return union_of(rows, [](const auto& row) {
    std::vector<std::string> names;
    for (const auto& stage : row.stages) names.push_back(stage.stage);
    return names;
  });
}

template <typename Value>
std::vector<double> numbers(const std::vector<AccuracyRow>& rows, Value&& value) {
  std::vector<double> result;
  for (const auto& row : rows) result.push_back(value(row));
  return result;
}

std::vector<CsvColumn> columns(const AccuracyStudy& study) {
  const auto& rows = study.rows;
  std::vector<std::string> models, meshes, marks;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    models.push_back(rows[i].model);
    meshes.push_back(rows[i].fineness);
    marks.push_back(rows[i].is_reference      ? "reference"
                    : study.chosen == i       ? "chosen"
                    : rows[i].is_contradicted ? "contradicted"
                    : rows[i].on_frontier     ? "frontier"
                                              : "");
  }
  std::vector<CsvColumn> result{{"model", "", models}, {"mesh", "", meshes}, {"mark", "", marks}};
  const auto add = [&](const std::string& name, const std::string& unit, auto&& value) {
    result.push_back({name, unit, numbers(rows, value)});
  };
  add("instants_per_turn", "1", [](const auto& row) { return double(row.instants_per_turn); });
  add("unknowns", "1", [](const auto& row) { return double(row.n_dofs); });
  add("value", "Pa", [](const auto& row) { return row.value_Pa; });
  add("largest_principal_stress", "Pa", [](const auto& row) { return row.principal_Pa; });
  add("error_estimated", "Pa", [](const auto& row) { return row.errors.total_Pa(); });
  add("error_true", "Pa", [](const auto& row) { return row.true_error_Pa; });
  add("effectivity", "1", [](const auto& row) { return effectivity(row); });
  add("seconds", "s", [](const auto& row) { return row.seconds; });
  add("seconds_spread", "s", [](const auto& row) { return row.spread_s; });
  add("memory", "GB", [](const auto& row) { return row.gigabytes; });
  for (const auto& source : sources(rows))
    add("error." + source, "Pa", [&](const auto& row) { return row.errors.of(source); });
  for (const auto& stage : stages(rows))
    add("seconds." + stage, "s", [&](const auto& row) { return seconds_of(row.stages, stage); });
  return result;
}

}  // namespace

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
              ? fmt::format("; its own estimate {:.2f} MPa)\n\n", study.reference_error_Pa / 1e6)
              : ")\n\n");
  out << fmt::format("    {:<16}{:>10}{:>9}{:>10}{:>10}{:>9}{:>9}{:>7}  {}\n", "model", "unknowns", "MPa",
                     "estimate", "true", "seconds", "spread", "GB", "mesh");
  for (std::size_t i = 0; i < study.rows.size(); ++i) {
    const auto& row = study.rows[i];
    const double percent = study.reference_Pa > 0 ? 100 / study.reference_Pa : 0;
    const char mark = row.is_reference      ? 'R'
                      : study.chosen == i   ? '>'
                      : row.is_contradicted ? '!'
                      : row.on_frontier     ? '*'
                                            : ' ';
    out << fmt::format("  {} {:<16}{:>10}{:>9.2f}{:>9.2f}%{:>9.2f}%{:>9.3g}{:>9.2g}{:>7.2g}  {}\n", mark,
                       row.model, row.n_dofs, row.value_Pa / 1e6, percent * row.errors.total_Pa(),
                       percent * row.true_error_Pa, row.seconds, row.spread_s, row.gigabytes, row.fineness);
  }
  for (const auto& model : study.left_out)
    out << fmt::format("    {:<15} left out: {}\n", model.model, model.why);
  const auto e = effectivities(study);
  out << fmt::format(
             "\n  > chosen: cheapest within {:g} % by its own estimate; * no cheaper run is closer; R "
             "reference\n",
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
  write_csv(file, in_shown_units(columns(study)));
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
    for (const auto& column : columns(study)) {
      const std::string object = group + "/" + column.name;
      if (const auto* text = std::get_if<std::vector<std::string>>(&column.cells))
        writer.write(object, *text);
      else
        writer.write(object, std::get<std::vector<double>>(column.cells), {column.unit, ""});
    }
  }
  writer.close();
  atomic.commit();
}

}  // namespace pipelines
