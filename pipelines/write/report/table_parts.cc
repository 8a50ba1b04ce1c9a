#include "pipelines/write/report/table_parts.h"

#include <fmt/core.h>

#include <ostream>

#include "pipelines/base/common/constants.h"
#include "pipelines/judge/texts/moment.h"
#include "pipelines/judge/verdict/verdict_text.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/scene/machines/load_table_reader.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/write/fields/bearing_fields.h"

namespace pipelines {
namespace {

std::string window_of(const RunReport& report) {
  const auto& grid = report.scene.sampling;
  if (!report.scene.run_up)
    return fmt::format("{} turn{} of {} instants", grid.turns, grid.turns == 1 ? "" : "s",
                       grid.instants_per_turn);
  const auto& loads = report.loads;
  const auto last = loads.n_instants() - 1;
  return fmt::format("a run-up of {:.4g} s, {:.3g} turns, {} instants", loads.time_s[last],
                     (loads.phi_rad[last] - loads.phi_rad[0]) / (2 * pi), loads.n_instants());
}

}  // namespace

void print_title_and_verdict(std::ostream& out, const RunReport& report) {
  const auto verdict = judge(report);
  out << fmt::format("\n{}: {}\n  {} ({}), {}{}\n", report.scene.title, headline(verdict),
                     report.loads.machine, report.loads.convention, window_of(report),
                     left_out_text(verdict));
  for (const auto& setting : report.scene.settings) out << "  set on the command line: " << setting << '\n';
  for (const auto& samples : samples_read(report.scene.machine, report.scene.sampling))
    out << "  read " << samples.text() << '\n';
  print_verdict(out, verdict);
}

void print_loads(std::ostream& out, const RunReport& report) {
  const MachineKind& kind = kind_of(report.scene.machine);
  std::vector<LoadFigure> headlines;  // the rest is in summary.json
  for (auto& figure : load_figures(report.scene, report.loads))
    if (kind.is_headline(figure.name)) headlines.push_back(std::move(figure));
  print_rows(out, "load", shown_named_rows("load", fields_of(load_fields()), loads_json(headlines)));
}

void print_resampling(std::ostream& out, const RunReport& report) {
  const auto errors = resampling_errors(report.scene.machine, report.scene.sampling);
  if (errors.empty()) return;
  out << fmt::format("\n  {:<36}{:>14}{:>14}{:>18}\n", "samples", "largest", "jump at seam",
                     "between samples");
  for (const auto& e : errors)
    out << fmt::format("  {:<36}{:>14.5g}{:>14.3g}{:>18.3g}\n", e.effect + "/" + e.port + "." + e.component,
                       e.largest, e.jump, e.between);
}

void print_bearings(std::ostream& out, const RunReport& report) {
  std::vector<std::vector<std::string>> notes;
  for (const auto& bearing : report.bearings) notes.push_back(answer_lines(bearing.answers));
  print_rows(out, "bearing", shown_bearings(bearings_json(report.bearings)), notes);
}

std::string moment_text(const RunReport& report, std::int32_t instant) {
  const auto moment = moment_of(report.scene, report.loads, instant);
  return fmt::format("turn {}, {:.0f} deg", moment.turn, moment.angle_rad * 180 / pi);
}

std::string point_text(const std::array<double, 3>& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", p[0] * 1e3, p[1] * 1e3, p[2] * 1e3);
}

}  // namespace pipelines
