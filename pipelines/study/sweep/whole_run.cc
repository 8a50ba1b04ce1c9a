#include "pipelines/study/sweep/whole_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/life/duty_result.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/judge/texts/life_text.h"
#include "pipelines/judge/verdict/torsion_report.h"
#include "pipelines/judge/verdict/verdict.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/search/loop/duty_loads.h"
#include "pipelines/search/loop/duty_run.h"
#include "pipelines/search/loop/scene_run.h"

namespace pipelines {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

class WholeRow {
public:
  WholeRow(SweepRow& row, const std::string& body) : row_(row), body_("bodies." + body) {}

  void add(const std::string& name, const std::string& unit, double value) {
    row_.figures.add({body_, name}, unit, value);
  }

  /// @param least  what the error leaves of the value; none: the error is not known
  void add_error(const std::string& name, const std::string& unit, double value,
                 const std::optional<double>& least) {
    add(name + ".error", unit, !least ? unbounded : *least == value ? 0 : value - *least);
  }

  void add_with_least(const std::string& name, const std::string& unit, double value,
                      const std::optional<double>& least) {
    add(name, unit, value);
    add_error(name, unit, value, least);
  }

  /// @param life_s  none: endures
  void add_life(const std::string& name, const std::optional<double>& life_s,
                const LifeCertainty& certainty) {
    std::optional<double> least_h;
    if (certainty.range) least_h = certainty.range->least_s.value_or(unbounded) / seconds_per_hour;
    add_with_least(name, "h", life_s.value_or(unbounded) / seconds_per_hour, least_h);
  }

  void add_text(const std::string& name, const std::string& text) {
    row_.texts.emplace_back(body_ + name, text);
  }

private:
  SweepRow& row_;
  std::string body_;
};

void add_errors(WholeRow& row, const Judged& analysis) {
  const auto stress = governing_stress(analysis);
  const double error_Pa = stress.errors.total_Pa();
  row.add(".governing.error.total", "Pa", error_Pa);
  if (stress.value_Pa > 0)
    row.add_error(".governing.safety", "", stress.safety,
                  stress.safety * stress.value_Pa / (stress.value_Pa + error_Pa));
  row.add(".peak_von_mises.error", "Pa", analysis.peak.errors.total_Pa());
  if (!analysis.hot_spots.empty()) row.add(".hot_spot.error", "Pa", analysis.hot_spot_errors.total_Pa());
}

void add_fatigue(WholeRow& row, const BodyFatigue& fatigue) {
  if (!fatigue.places.empty()) {
    const auto& place = fatigue.places.front();
    row.add(".fatigue.utilisation", "", place.utilisation);
    row.add(".fatigue.utilisation.error", "", place.utilisation * place.error_share);
    row.add_with_least(".fatigue.safety", "", place.safety, least_safety(place.safety, place.error_share));
    const auto shortest = std::min_element(
        fatigue.places.begin(), fatigue.places.end(), [](const FatiguePlace& a, const FatiguePlace& b) {
          return a.life_s.value_or(unbounded) < b.life_s.value_or(unbounded);
        });
    row.add_life(".fatigue.life", shortest->life_s, shortest->certainty);
    row.add_text(".fatigue.place", place.feature);
  }
  if (!fatigue.welds.empty())
    row.add_life(".welds.life", fatigue.welds.front().life_s, fatigue.welds.front().certainty);
}

/// Over all operating blocks.
void add_duty(SweepRow& row, const DutyResult& duty) {
  for (const auto& [body, places] : duty.places)
    if (!places.empty())
      WholeRow(row, body).add_life(".duty.life", places.front().life_s, places.front().certainty);
  for (const auto& bearing : duty.bearings)
    row.figures.add({"bearings.", bearing.name, ".duty.life"}, "h", bearing.life_h.value_or(unbounded));
}

void add_verdict(SweepRow& row, const Verdict& verdict) {
  for (const auto& part : verdict.parts) {
    WholeRow of_part(row, part.name);
    of_part.add_text(".verdict", to_string(part.judgement));
    for (const auto& finding : part.findings)
      if (finding.margin && part.name != "bearings" && part.name != "drive train")
        of_part.add_with_least(".margin." + finding.criterion, "", *finding.margin, finding.least_margin);
  }
}

}  // namespace

bool is_of_fatigue(const std::string& figure) {
  for (const char* part : {".fatigue.", ".welds.", ".duty.", ".margin."})
    if (figure.find(part) != std::string::npos) return true;
  return false;
}

SweepRow whole_run(const Scene& scene, const SweepOptions& options, StageClock& clock) {
  require_blocks(scene);
  SceneRunOptions run_options;
  run_options.n_threads = options.n_threads;
  run_options.fresh = options.fresh;
  run_options.accuracy = options.accuracy;
  run_options.fatigue = options.fatigue;
  run_options.duty = options.fatigue && !scene.duty.empty();
  const auto run = run_scene(scene, run_options, clock);
  std::optional<DutyResult> duty;
  if (run_options.duty) duty = run_duty(scene, run, options.n_threads, clock);
  Scene reported = run.loaded.scene;
  reported.machine = run.loaded.masses.machine;

  SweepRow row;
  add_load_figures(row, reported, run.loaded.loads, run.loaded.bearings);
  for (const auto& analysis : run.analyses) {
    WholeRow of_body(row, analysis.scene.name);
    add_body_figures(row, analysis, largest_torsion(analysis));
    add_errors(of_body, analysis);
    if (analysis.fatigue) add_fatigue(of_body, *analysis.fatigue);
  }
  if (!options.zones) row.zones.clear();
  if (!options.fatigue) return row;
  if (duty) add_duty(row, *duty);
  std::optional<TorsionReport> torsion;
  if (kind_of(reported.machine).is_torsional()) torsion = report_torsion(reported, reported.machine);
  add_verdict(row, judge({reported, run.loaded.loads, run.analyses, run.loaded.masses.figures, clock.costs(),
                          run.loaded.bearings, duty ? &*duty : nullptr, torsion ? &*torsion : nullptr}));
  return row;
}

}  // namespace pipelines
