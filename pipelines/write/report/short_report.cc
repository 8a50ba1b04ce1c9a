/// The table on the terminal: what an engineer decides on, and what governs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <ostream>
#include <vector>

#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/judge/texts/life_text.h"
#include "pipelines/write/fields/zone_fields.h"
#include "pipelines/write/parts/duty_report.h"
#include "pipelines/write/parts/fatigue_assumptions.h"
#include "pipelines/write/parts/fatigue_report.h"
#include "pipelines/write/parts/shaft_torsion_report.h"
#include "pipelines/write/report/summary.h"
#include "pipelines/write/report/table_parts.h"

namespace pipelines {
namespace {

constexpr std::size_t rows_of_zones = 3, rows_of_lives = 2;
constexpr double same_value = 1e-3;  ///< relative: mirror images are meshed alike, or nearly so
constexpr double known_by_half = 0.5;

bool is_same(double a, double b) {
  return std::abs(a - b) <= same_value * std::max(std::abs(a), std::abs(b));
}

void print_governing_stress(std::ostream& out, const RunReport& report, const Judged& analysis) {
  const auto stress = governing_stress(analysis);
  out << fmt::format("\n  {}: {} {}, safety against yield {}\n", analysis.scene.name, stress.name(),
                     value_with_shares(stress.value_Pa, stress.errors), fixed(stress.safety, 2));
  out << fmt::format("    at {} ({}), {}, {}\n", stress.place, to_string(stress.surface),
                     point_text(stress.position_m), moment_text(report, stress.instant));
  if (const auto trouble = not_known_well(stress, analysis.search); !trouble.empty())
    out << "    NOT KNOWN WELL: " << trouble << '\n';
  if (const auto rise = rises_towards_edge(analysis); !rise.empty())
    out << "    SHARP EDGE: " << rise << '\n';
  if (stress.kind == GoverningStress::Kind::peak) return;
  const Peak& peak = analysis.peak;
  out << fmt::format("    peak von Mises stress outside the exclusion distances {}, at {} ({})\n",
                     value_with_shares(peak.value_Pa, peak.errors), peak.feature, to_string(peak.place));
}

std::string model_text(const Judged& analysis) {
  auto text = fmt::format("{} unknowns, {:.3f} kg", analysis.responses.n_dofs, analysis.masses.mass_kg);
  if (analysis.method == Method::beam)
    text += ", by the beam model: no section diagrams, no torsion along the shaft, zones without volume";
  else if (analysis.method != Method::solid)
    text += fmt::format(", by the {} model", to_string(analysis.method));
  if (analysis.responses_reused) text += ", responses of an earlier run";
  const auto& search = analysis.search;
  if (search.steps.empty()) return text;
  text += fmt::format("; {} step{}, {}{}", search.steps.size(), search.steps.size() == 1 ? "" : "s",
                      search.met ? "" : "NOT MET: ", search.ended);
  if (search.tolerance > 0) text += fmt::format(" ({:.3g} % was asked)", 100 * search.tolerance);
  if (search.time_was_up()) text += fmt::format("; the next step needs about {:.0f} s", search.next_seconds);
  return text;
}

void print_other_stresses(std::ostream& out, const Judged& analysis) {
  out << fmt::format("    largest principal stress {} MPa",
                     stress_in_MPa(analysis.envelope.principal.value_Pa[analysis.principal_node], 0));
  if (const auto* ring = analysis.diagrams ? largest_torsion_ring(*analysis.diagrams) : nullptr) {
    if (is_rounding(analysis, *ring))
      out << "; no torsional stress: nothing twists the shaft";
    else
      out << fmt::format("; torsional {} MPa at {}, z = {:.1f} mm",
                         with_error(ring->max_Pa, ring_error_Pa(analysis, *ring)), ring->feature,
                         ring->z_m * 1e3);
  }
  out << '\n';
}

/// A zone of the same stress at the same moment as the one before: on the other side of a plane of symmetry.
bool is_mirror_image(const Zone& zone, const Zone& first) {
  if (zone.place != first.place || zone.instant != first.instant || !is_same(zone.peak_Pa, first.peak_Pa))
    return false;
  int alike = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double size = std::abs(zone.peak_m[d]) + std::abs(first.peak_m[d]);
    alike += std::abs(zone.peak_m[d] - first.peak_m[d]) <= 10 * same_value * size + 1e-6;
  }
  return alike == 2;
}

struct ZoneRow {
  std::size_t zone = 0;
  int n_alike = 1;
};

std::vector<ZoneRow> zone_rows(const std::vector<Zone>& zones) {
  std::vector<ZoneRow> rows;
  for (std::size_t i = 0; i < zones.size(); ++i) {
    const auto alike = std::find_if(rows.begin(), rows.end(), [&](const auto& row) {
      return is_mirror_image(zones[i], zones[row.zone]);
    });
    if (alike == rows.end())
      rows.push_back({i});
    else
      ++alike->n_alike;
  }
  return rows;
}

bool is_known(const Judged& analysis, const Zone& zone) {
  const auto error = error_Pa(analysis, zone);
  return error && *error < known_by_half * zone.peak_Pa;
}

/// The largest zones; mirror images are one, those that are known worse than to half of themselves are
/// counted.
void print_short_zones(std::ostream& out, const RunReport& report, const Judged& analysis) {
  const auto& zones = analysis.zones.zones;
  out << fmt::format("    {:<46}{:>16}{:>8}{:>12}  moment, surface\n",
                     fmt::format("zones above {} MPa", stress_in_MPa(analysis.zones.level_Pa, 0)), "MPa",
                     "safety", "mm3");
  std::size_t n_shown = 0, n_zones_in_rows = 0;
  for (const auto& row : zone_rows(zones)) {
    const auto& zone = zones[row.zone];
    if (n_shown == rows_of_zones || (n_shown > 0 && !is_known(analysis, zone))) continue;
    ++n_shown;
    n_zones_in_rows += std::size_t(row.n_alike);
    const char* image = row.n_alike == 1   ? ""
                        : row.n_alike == 2 ? " and its mirror image"
                                           : " and its mirror images";
    const auto error = error_Pa(analysis, zone);
    out << fmt::format("      {:<44}{:>16}{:>8}{:>12}  {}, {}\n", zone.feature + image,
                       error ? with_error(zone.peak_Pa, *error) : stress_in_MPa(zone.peak_Pa, 0),
                       fixed(zone.safety, 2), volume_text(zone.volume_m3, zone.volume_error_m3).volume,
                       moment_text(report, zone.instant), to_string(zone.place));
    if (n_shown > 1) continue;
    const auto causes =
        causes_of_row(summary_row(zone_fields(), {{report.scene, report.loads, analysis}, zone, row.zone}));
    if (!causes.empty()) out << "        " << causes << '\n';
  }
  if (zones.size() > n_zones_in_rows)
    out << fmt::format("      and {} more in {}/zones.csv\n", zones.size() - n_zones_in_rows,
                       analysis.scene.name);
}

/// A place or weld toe by the range that it bears and the life that follows.
struct LifeRow {
  std::string place;
  double range_Pa = 0, error_share = 0;
  std::optional<double> margin;  ///< against the wanted life; none: nothing changes
  std::string life;
  int n_alike = 1;
};

void add_row(std::vector<LifeRow>& rows, LifeRow row) {
  const auto alike = std::find_if(rows.begin(), rows.end(), [&](const auto& other) {
    return is_same(row.range_Pa, other.range_Pa) && row.life == other.life;
  });
  if (alike == rows.end())
    rows.push_back(std::move(row));
  else
    ++alike->n_alike;
}

/// Welds and surface alike, the least margin first.
std::vector<LifeRow> life_rows(const Judged& analysis) {
  std::vector<LifeRow> rows;
  for (const auto& weld : analysis.fatigue->welds)
    add_row(rows, {weld.name + " (weld toe)", weld.range_Pa, weld.error_share, weld.life_safety,
                   life_text(weld.life_s, weld.certainty)});
  for (const auto& place : analysis.fatigue->places) {
    auto life = life_text(place.life_s, place.certainty);
    if (!place.life_s && place.life_safety)
      life += fmt::format(", factor {} left", safety_text(*place.life_safety, place.error_share));
    add_row(rows, {place.feature, 2 * place.cycle.amplitude_Pa, place.error_share, place.life_safety,
                   std::move(life)});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    constexpr double never = std::numeric_limits<double>::infinity();
    return a.margin.value_or(never) < b.margin.value_or(never);
  });
  return rows;
}

void print_lives(std::ostream& out, const Judged& analysis) {
  if (!analysis.fatigue) return;
  const auto rows = life_rows(analysis);
  out << fmt::format("    {:<46}{:>16}  life\n", "fatigue", "range MPa");
  for (std::size_t i = 0; i < std::min(rows_of_lives, rows.size()); ++i)
    out << fmt::format("      {:<44}{:>16}  {}\n",
                       rows[i].place + (rows[i].n_alike > 1 ? " and its mirror image" : ""),
                       with_error(rows[i].range_Pa, rows[i].error_share * rows[i].range_Pa), rows[i].life);
}

/// Prints which size the strength is for, before any life that follows from it.
void print_strength(std::ostream& out, const RunReport& report, const Judged& analysis) {
  if (analysis.fatigue) out << "    " << strength_text(report.scene, analysis) << '\n';
}

void print_weld_toes(std::ostream& out, const RunReport& report, const Judged& analysis) {
  if (analysis.fatigue || analysis.hot_spots.empty()) return;
  const auto& spot = analysis.hot_spots.front();
  out << fmt::format("    hot-spot stress at {}: {} MPa, range across the weld {} MPa, {}\n", spot.name,
                     with_error(spot.von_mises_Pa, error_Pa(analysis, spot)),
                     fixed((spot.max_normal_Pa - spot.min_normal_Pa) / 1e6, 1),
                     moment_text(report, spot.instant));
}

void print_deflections(std::ostream& out, const Judged& analysis) {
  if (!analysis.diagrams || analysis.diagrams->seats.empty()) return;
  const auto& seats = analysis.diagrams->seats;
  const auto most = [&](double SeatMotion::*what) {
    return std::max_element(seats.begin(), seats.end(),
                            [=](const auto& a, const auto& b) { return a.*what < b.*what; });
  };
  const auto moved = most(&SeatMotion::max_deflection_m), turned = most(&SeatMotion::max_slope_rad);
  out << fmt::format("    deflection {:.4f} mm at {}; slope {:.3f} mrad at {}\n",
                     moved->max_deflection_m * 1e3, moved->port, turned->max_slope_rad * 1e3, turned->port);
}

void print_short_vibration(std::ostream& out, const Judged& analysis) {
  if (!analysis.vibration) return;
  out << "    natural frequencies";
  for (const auto& natural : analysis.vibration->natural_frequencies)
    out << fmt::format("  {:.4g} ({:.4g})", natural.value_Hz, natural.least_Hz());
  out << " Hz, " << analysis.vibration->held << '\n';
}

void print_short_critical_speeds(std::ostream& out, const Judged& analysis) {
  if (!analysis.critical_speeds) return;
  const auto& speeds = *analysis.critical_speeds;
  constexpr double rpm = pi / 30;
  out << "    critical speeds";
  for (const auto& mode : speeds.modes)
    if (mode.order > 0) out << fmt::format("  {:.5g}", mode.speed_rad_s / rpm);
  out << fmt::format(" rpm at {:.5g} rpm, {}; {}\n", speeds.speed_rad_s / rpm, speeds.held,
                     model_error_text(speeds));
}

void print_short_body(std::ostream& out, const RunReport& report, const Judged& analysis) {
  print_governing_stress(out, report, analysis);
  out << "    " << model_text(analysis) << '\n';
  if (const auto corners = corners_left_out(analysis); !corners.empty())
    out << "    left out, since stress grows without bound at a sharp corner: " << corners << '\n';
  print_other_stresses(out, analysis);
  print_short_zones(out, report, analysis);
  print_strength(out, report, analysis);
  if (report.duty == nullptr) print_lives(out, analysis);
  print_weld_toes(out, report, analysis);
  print_short_vibration(out, analysis);
  print_short_critical_speeds(out, analysis);
  print_element_torsion(out, report, analysis);
  print_start_up(out, analysis);
  print_deflections(out, analysis);
}

/// "took 28.5 s (solve 15.1, superpose 2.9, refine 2.8, pictures 2.4)"
void print_seconds(std::ostream& out, const std::vector<StageCost>& costs) {
  constexpr std::size_t told = 4;
  auto by_size = costs;
  std::stable_sort(by_size.begin(), by_size.end(),
                   [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
  double total = 0;
  for (const auto& cost : costs) total += cost.seconds;
  std::string largest;
  for (std::size_t i = 0; i < std::min(told, by_size.size()); ++i)
    largest += fmt::format("{}{} {:.1f}", i > 0 ? ", " : "", by_size[i].stage, by_size[i].seconds);
  out << fmt::format("\n  took {:.1f} s ({}), {:.1f} GB at most; -v prints all figures\n", total, largest,
                     peak_memory_gigabytes());
}

}  // namespace

void print_report(std::ostream& out, const RunReport& report) {
  print_title_and_verdict(out, report);
  print_loads(out, report);
  for (const auto& analysis : report.bodies) print_short_body(out, report, analysis);
  print_effect_choice(out, report.scene, report.bodies);
  print_resampling(out, report);
  print_bearings(out, report);
  if (report.duty != nullptr) print_duty(out, *report.duty);
  print_seconds(out, report.costs);
  for (const auto* warnings : {&report.scene.warnings, &report.loads.warnings})
    for (const auto& warning : *warnings) out << "  warning: " << warning << '\n';
}

}  // namespace pipelines
