/// The table with all figures, as -v prints it.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "pipelines/analysis/error_text.h"
#include "pipelines/analysis/governing_stress.h"
#include "pipelines/body_stages/shaft_torsion.h"
#include "pipelines/common/constants.h"
#include "pipelines/report/summary.h"
#include "pipelines/report/table_parts.h"
#include "pipelines/report_parts/duty_report.h"
#include "pipelines/report_parts/fatigue_assumptions.h"
#include "pipelines/report_parts/fatigue_report.h"
#include "pipelines/report_parts/shaft_torsion_report.h"
#include "pipelines/report_parts/zone_text.h"

namespace pipelines {
namespace {

void print_masses(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis) {
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

void print_hot_spots(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis) {
  if (analysis.hot_spots.empty()) return;
  out << fmt::format("\n  {:<40}{:>14}{:>10}{:>20}  {}\n", "weld toe, hot-spot stress", "von Mises MPa",
                     "+- MPa", "range across MPa", "moment");
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; i < std::min(shown, analysis.hot_spots.size()); ++i) {
    const auto& spot = analysis.hot_spots[i];
    out << fmt::format("  {:<40}{:>14}{:>10}{:>20.1f}  {}\n", spot.name,
                       stress_in_MPa(spot.von_mises_Pa, error_Pa(analysis, spot)),
                       fixed(error_Pa(analysis, spot) / 1e6, 1),
                       (spot.max_normal_Pa - spot.min_normal_Pa) / 1e6, moment_text(report, spot.instant));
  }
}

void print_search(std::ostream& out, const Search& search) {
  if (search.steps.empty()) return;
  out << fmt::format("\n  {:<24}{:>9}{:>10}{:>11}{:>9}  {}\n", search.quantity, "MPa", "error", "unknowns",
                     "seconds", "dominated by, mesh");
  int n = 0;
  for (const auto& step : search.steps)
    out << fmt::format("    step {:<17}{:>9}{:>9.1f}%{:>11}{:>9.1f}  {}; {}\n", ++n,
                       stress_in_MPa(step.value_Pa, step.errors.reducible_Pa()),
                       step.value_Pa > 0 ? 100 * step.errors.reducible_Pa() / step.value_Pa : 0.0,
                       step.n_dofs, step.seconds, step.errors.largest_reducible(), step.fineness);
  out << fmt::format("  {}: {}", search.met ? "ended" : "NOT MET", search.ended);
  if (search.tolerance > 0) out << fmt::format("; {:.3g} % was asked", 100 * search.tolerance);
  if (search.time_was_up()) out << fmt::format("; the next step needs about {:.0f} s", search.next_seconds);
  out << '\n';
}

void print_vibration(std::ostream& out, const Vibration& vibration) {
  out << "\n  natural frequencies [Hz]";
  for (const auto& natural : vibration.natural_frequencies) out << fmt::format("  {:.5g}", natural.value_Hz);
  out << "\n  lower by at most    [Hz]";
  for (const auto& natural : vibration.natural_frequencies) out << fmt::format("  {:.2g}", natural.error_Hz);
  const auto& dynamic = vibration.amplification;
  out << fmt::format(
      "   ({})\n  dynamic amplification    {:.4f} of the peak{}; harmonic {:.4g} at {:.4g} Hz: "
      "{:.3g} % of it, times {:.4f}\n",
      vibration.held, 1 + vibration.to_peak.share,
      vibration.to_peak.place.empty() ? "" : ", at " + vibration.to_peak.place, dynamic.highest.order,
      dynamic.highest.frequency_Hz, 100 * dynamic.highest.share, dynamic.highest.amplification);
}

/// What the body is judged by, first of all that it is not known well.
void print_governing(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis) {
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

/// The peak, where a hot spot is worse.
void print_peak(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis) {
  if (governing_stress(analysis).kind == GoverningStress::Kind::peak) return;
  const Peak& peak = analysis.peak;
  out << fmt::format(
      "\n  peak von Mises stress outside the exclusion distances {}, safety against yield {}\n",
      value_with_errors(peak.value_Pa, peak.errors), fixed(peak.safety, 2));
  out << fmt::format("    at {} ({}), {}, {}\n", peak.feature, to_string(peak.place),
                     point_text(peak.position_m), moment_text(report, peak.instant));
}

void print_zones(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis) {
  const auto& zones = analysis.zones.zones;
  out << fmt::format("\n  zones above {} MPa{:>22}{:>9}{:>9}{:>13}{:>14}  {:<20}{}\n",
                     stress_in_MPa(analysis.zones.level_Pa, 0), "peak MPa", "+- MPa", "safety", "volume mm3",
                     "+- mm3", "  moment", "where");
  for (std::size_t i = 0; i < std::min(n_zones_shown, zones.size()); ++i) {
    const auto error = error_Pa(analysis, zones[i]);
    const auto volume = volume_text(zones[i].volume_m3, zones[i].volume_error_m3);
    out << fmt::format("  {:>3}  {:<34}{:>7}{:>9}{:>9}{:>13} {:>13}  {:<20}{}\n", i + 1, zones[i].feature,
                       stress_in_MPa(zones[i].peak_Pa, error.value_or(0)),
                       error ? fixed(*error / 1e6, 1) : "-", fixed(zones[i].safety, 2), volume.volume,
                       volume.error, "  " + moment_text(report, zones[i].instant), to_string(zones[i].place));
    for (const auto& text : {causes_text(analysis, i), parts_text(zones[i])})
      if (!text.empty()) out << "       " << text << '\n';
  }
  if (zones.size() > n_zones_shown)
    out << fmt::format("       and {} more in zones.csv\n", zones.size() - n_zones_shown);
}

void print_solver(std::ostream& out, const BodyAnalysis& analysis) {
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

void print_body(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis) {
  if (analysis.fatigue) out << "\n  " << analysis.scene.name << ": " << strength_text(report.scene, analysis);
  print_governing(out, report, analysis);
  print_solver(out, analysis);
  out << fmt::format("  closure on the mesh: forces {:.1e}, moments {:.1e}\n", analysis.closure.worst_force(),
                     analysis.closure.worst_moment());
  print_masses(out, report, analysis);
  print_peak(out, report, analysis);
  if (const auto corners = corners_left_out(analysis); !corners.empty())
    out << "  left out, since stress grows without bound at a sharp corner: " << corners << '\n';
  print_search(out, analysis.search);
  const std::size_t p = analysis.principal_node;
  out << fmt::format("  largest principal stress {} MPa\n",
                     stress_in_MPa(analysis.envelope.principal.value_Pa[p], 0));
  if (const auto* ring = analysis.diagrams ? largest_torsion_ring(*analysis.diagrams) : nullptr) {
    const double error_Pa = ring_error_Pa(analysis, *ring);
    if (is_rounding(analysis, *ring))
      out << "  no torsional stress: nothing twists the shaft\n";
    else
      out << fmt::format(
          "  largest torsional stress {} MPa{} at {}, z = {:.1f} mm\n", fixed(ring->max_Pa / 1e6, 2),
          std::isfinite(error_Pa) ? " +- " + fixed(error_Pa / 1e6, 2) : "", ring->feature, ring->z_m * 1e3);
  }

  print_zones(out, report, analysis);
  if (analysis.vibration) print_vibration(out, *analysis.vibration);
  print_hot_spots(out, report, analysis);
  print_fatigue(out, report, analysis);
  print_element_torsion(out, report, analysis);
  print_start_up(out, analysis);
  if (!analysis.diagrams) return;
  out << fmt::format("\n  {:<28}{:>16}{:>16}\n", "seat", "deflection mm", "slope mrad");
  for (const auto& seat : analysis.diagrams->seats)
    out << fmt::format("  {:<28}{:>16.4f}{:>16.3f}\n", seat.port, seat.max_deflection_m * 1e3,
                       seat.max_slope_rad * 1e3);
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
  double total = 0;
  out << fmt::format("\n  {:<28}{:>12}\n", "stage", "seconds");
  for (const auto& cost : report.costs) {
    out << fmt::format("  {:<28}{:>12.2f}\n", cost.stage, cost.seconds);
    total += cost.seconds;
  }
  out << fmt::format("  {:<28}{:>12.2f}   peak memory {:.1f} GB\n", "total", total, peak_memory_gigabytes());
  for (const auto& warning : report.scene.warnings) out << "  warning: " << warning << '\n';
  for (const auto& warning : report.loads.warnings) out << "  warning: " << warning << '\n';
}

}  // namespace pipelines
