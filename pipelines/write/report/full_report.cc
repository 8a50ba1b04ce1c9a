/// The table with all figures, as -v prints it.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/write/fields/run_fields.h"
#include "pipelines/write/fields/zone_fields.h"
#include "pipelines/write/parts/duty_report.h"
#include "pipelines/write/parts/fatigue_assumptions.h"
#include "pipelines/write/parts/fatigue_report.h"
#include "pipelines/write/parts/shaft_torsion_report.h"
#include "pipelines/write/report/summary.h"
#include "pipelines/write/report/table_parts.h"

namespace pipelines {
namespace {

void print_masses(std::ostream& out, const RunReport& report, const Responded& analysis) {
  for (const auto& figure : report.masses)
    if (figure.body == analysis.scene.name)
      out << fmt::format("  {}: {:.5g} {}{}\n", figure.name, figure.given, figure.unit,
                         figure.from_mesh
                             ? " from the mesh"
                             : fmt::format(", mesh and added masses have {:.5g}: {:.2g} % carried on {}",
                                           figure.mesh, 100 * figure.share(), figure.port));
  const auto& carried = analysis.loads.carried_moment_Nm;
  if (carried.size() > 0)
    out << fmt::format("  pitch is off: a guide carries a couple of up to {:.4g} N m, rms {:.4g} N m\n",
                       carried.abs().maxCoeff(), std::sqrt(carried.square().mean()));
}

void print_hot_spots(std::ostream& out, const BodyResult& body) {
  constexpr std::size_t shown = 5;
  const auto fields = hot_spot_fields();
  print_rows(out, "weld toe, hot-spot stress",
             shown_rows(fields_of(fields), summary_rows(fields, body, body.analysis.hot_spots), shown));
}

void print_search(std::ostream& out, const Search& search) {
  if (search.steps.empty()) return;
  const auto steps = whole_rows(search_step_fields(), search.steps);
  print_rows(out, search.quantity + ", step",
             shown_named_rows("step", fields_of(search_step_fields()), steps));
  out << fmt::format("  {}: {}", search.met ? "ended" : "NOT MET", search.ended);
  if (search.tolerance > 0) out << fmt::format("; {:.3g} % was asked", 100 * search.tolerance);
  if (search.time_was_up()) out << fmt::format("; the next step needs about {:.0f} s", search.next_seconds);
  out << '\n';
}

void print_vibration(std::ostream& out, const Vibration& vibration) {
  const auto rows = whole_rows(natural_frequency_fields(), vibration.natural_frequencies);
  print_rows(out, "mode", shown_named_rows("mode", fields_of(natural_frequency_fields()), rows));
  const auto& dynamic = vibration.amplification;
  out << fmt::format(
      "  {}\n  dynamic amplification    {:.4f} of the peak{}; harmonic {:.4g} at {:.4g} Hz: "
      "{:.3g} % of it, times {:.4f}\n",
      vibration.held, 1 + vibration.to_peak.share,
      vibration.to_peak.place.empty() ? "" : ", at " + vibration.to_peak.place, dynamic.highest.order,
      dynamic.highest.frequency_Hz, 100 * dynamic.highest.share, dynamic.highest.amplification);
}

void print_critical_speeds(std::ostream& out, const CriticalSpeeds& speeds) {
  const auto fields = fields_of(critical_speed_fields());
  for (const auto& [title, list] :
       {std::pair("whirl", &speeds.modes), {"nearest of each load", &speeds.loads}})
    print_rows(out, title, shown_rows(fields, summary_rows(critical_speed_fields(), *list), list->size()));
  out << fmt::format("  {}; {}\n", speeds.held, model_error_text(speeds));
}

/// What the body is judged by, first of all that it is not known well.
void print_governing(std::ostream& out, const RunReport& report, const Judged& analysis) {
  const auto stress = governing_stress(analysis);
  out << "\n  " << analysis.scene.name << ": ";
  if (const auto trouble = not_known_well(stress, analysis.search); !trouble.empty())
    out << "NOT KNOWN WELL: " << trouble << "\n  ";
  if (const auto rise = rises_towards_edge(analysis); !rise.empty()) out << "SHARP EDGE: " << rise << "\n  ";
  out << fmt::format("{} {}, safety against yield {}\n    at {} ({}), {}, {}\n", stress.name(),
                     value_with_errors(stress.value_Pa, stress.errors), fixed(stress.safety, 2), stress.place,
                     to_string(stress.surface), point_text(stress.position_m),
                     moment_text(report, stress.instant));
}

/// Prints the headlines beside the governing stress.
void print_headlines(std::ostream& out, const BodyResult& body) {
  auto rows = headline_rows(summary_row(headline_fields(), body));
  rows.cells.erase(rows.cells.begin());
  print_rows(out, "other stresses", rows);
}

void print_zones(std::ostream& out, const BodyResult& body) {
  const auto& zones = body.analysis.zones;
  const auto fields = zone_fields();
  const auto rows = summary_rows(fields, body, zones.zones);
  std::vector<std::vector<std::string>> notes;
  for (std::size_t i = 0; i < rows.size(); ++i)
    notes.push_back({causes_of_row(rows[i]), parts_text(zones.zones[i])});
  print_rows(out, fmt::format("zones above {} MPa", stress_in_MPa(zones.level_Pa, 0)),
             shown_rows(fields_of(fields), rows, n_zones_shown), notes);
  if (rows.size() > n_zones_shown)
    out << fmt::format("       and {} more in zones.csv\n", rows.size() - n_zones_shown);
}

void print_solver(std::ostream& out, const Responded& analysis) {
  out << fmt::format("  {} unknowns, {} unit loads{}; {:.3f} kg\n", analysis.responses.n_dofs,
                     analysis.responses.channels.size(),
                     analysis.responses_reused ? " (responses of an earlier run)" : "",
                     analysis.masses.mass_kg);
  const auto& solver = analysis.responses.solver;
  if (analysis.method != Method::solid)
    out << fmt::format("  by the {} model{}\n", to_string(analysis.method),
                       analysis.method == Method::beam
                           ? ": no section diagrams, no torsion along the shaft, zones without volume"
                           : "");
  else if (solver.used == fem::Solver::iterative)
    out << fmt::format("  solved by conjugate gradients, {} iterations ({})\n", solver.n_iterations,
                       solver.reason);
  else
    out << fmt::format("  solved by factorisation ({})\n", solver.reason);
  if (analysis.method == Method::solid)
    out << fmt::format("  the solver took {:.2f} GB, {:.2f} GB were predicted\n", 1e-9 * solver.used_bytes,
                       1e-9 * solver.predicted().bytes);
  for (std::size_t r = 0; r < solver.ranks.size(); ++r)
    out << fmt::format("    rank {}: {} of the unknowns, {:.2f} GB\n", r, solver.ranks[r].n_unknowns,
                       1e-9 * solver.ranks[r].bytes);
}

void print_body(std::ostream& out, const RunReport& report, const Judged& analysis) {
  const BodyResult body{report.scene, report.loads, analysis};
  if (analysis.fatigue) out << "\n  " << analysis.scene.name << ": " << strength_text(report.scene, analysis);
  print_governing(out, report, analysis);
  print_solver(out, analysis);
  out << fmt::format("  closure on the mesh: forces {:.1e}, moments {:.1e}\n", analysis.closure.worst_force(),
                     analysis.closure.worst_moment());
  print_masses(out, report, analysis);
  if (const auto corners = corners_left_out(analysis); !corners.empty())
    out << "  left out, since stress grows without bound at a sharp corner: " << corners << '\n';
  print_search(out, analysis.search);
  print_headlines(out, body);
  print_zones(out, body);
  if (analysis.vibration) print_vibration(out, *analysis.vibration);
  if (analysis.critical_speeds) print_critical_speeds(out, *analysis.critical_speeds);
  print_hot_spots(out, body);
  print_fatigue(out, report, analysis);
  print_element_torsion(out, report, analysis);
  print_start_up(out, analysis);
  if (analysis.diagrams) print_rows(out, "seat", shown_seats(seats_json(*analysis.diagrams)));
}

}  // namespace

void print_full_report(std::ostream& out, const RunReport& report) {
  print_title_and_verdict(out, report);
  print_loads(out, report);
  for (const auto& analysis : report.bodies) print_body(out, report, analysis);
  print_shortest_lives(out, report);
  print_effect_choice(out, report.scene, report.bodies);
  print_resampling(out, report);
  print_bearings(out, report);
  if (report.duty != nullptr) print_duty(out, *report.duty);
  print_list(out, stage_fields(), report.costs);
  double total = 0;
  for (const auto& cost : report.costs) total += cost.seconds;
  out << fmt::format("  total {:.2f} s, peak memory {:.1f} GB\n", total, peak_memory_gigabytes());
  for (const auto& warning : report.scene.warnings) out << "  warning: " << warning << '\n';
  for (const auto& warning : report.loads.warnings) out << "  warning: " << warning << '\n';
}

}  // namespace pipelines
