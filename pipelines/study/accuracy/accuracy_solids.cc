#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/judge/stages/judge_body.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/search/effect_choice/effect_report.h"
#include "pipelines/search/refinement/refinement.h"
#include "pipelines/study/accuracy/accuracy_models.h"

namespace pipelines {
namespace {

/// Solids of one polynomial degree on the scene's mesh made finer or coarser.
struct Series {
  std::string model;
  int degree = 2;
  std::vector<double> factors;
  /// Latest end, as a share of the time that even meshes find; what is predicted to end later is left out.
  double share_of_time = 0;
};

// Half the time is for even meshes, the rest for refined ones. Cells of degree 1 are there to show what they
// cost, and those of degree 3 give on half as fine a mesh what the scene's own mesh gives.
const Series linear{"Q1 solid", 1, {1, 2}, 0.25}, quadratic{"even mesh", 2, {0.5, 0.75, 1, 1.5, 2, 3}, 0.5},
    cubic{"Q3 solid", 3, {0.5, 0.75}, 0.6};

/// Seconds of the load stage that each effect is worth.
std::vector<std::pair<std::string, double>> evaluation_seconds(const Scene& scene) {
  std::vector<std::pair<std::string, double>> seconds;
  const double n_instants = double(scene.sampling.turns) * scene.sampling.instants_per_turn;
  for (const auto& worth : report_effects(scene, 0.01).effects)
    seconds.push_back({worth.effect.name, std::max(0.0, worth.per_instant.median_s) * n_instants});
  return seconds;
}

/// Fewer instants may be refused: they cannot tell a high order, or miss a shock.
bool tell_the_loads(const Scene& scene, const Machine& machine) {
  try {
    (void)load_stage(scene, machine);
    return true;
  } catch (const kinetics::MachineRefused&) {
    return false;
  }
}

/// Entries of the model that only the other budget has, as what resonance adds.
void take_over_model(const ErrorBudget& other, const char* method, ErrorBudget& errors) {
  for (const auto& entry : other.model)
    if (errors.of(entry.source) == 0) errors.set_model({entry.source, method, entry.value_Pa});
}

/// The same responses at fewer instants: only loads and superposition are done anew.
void fewer_instants(AccuracyBench& bench, const AccuracyRow& full, SceneRun run,
                    std::vector<AccuracyRow>& rows) {
  Scene scene = bench.scene();
  const auto body = bench.index();
  for (const int divisor : {2, 4, 8}) {
    scene.sampling.instants_per_turn = bench.scene().sampling.instants_per_turn / divisor;
    if (scene.sampling.instants_per_turn < 8 || !tell_the_loads(scene, run.loaded.masses.machine)) return;
    StageClock own;
    run.loaded = load_bodies(scene, std::move(run.loaded.meshed), own);
    auto& analysis = run.analyses.front();
    const auto& meshed = run.loaded.meshed[body];
    auto fewer =
        responded(scene.bodies[body], meshed, run.loaded.body_loads[body], std::move(analysis.responses));
    const int n_threads = bench.options().n_threads;
    analysis = judge_body(superpose(std::move(fewer), threads(n_threads), own), meshed, true, n_threads, own,
                          std::vector(analysis.hot_spots));
    auto row = row_of("fewer instants", run);
    row.fineness = fmt::format("{} instants per turn; {}", row.instants_per_turn, row.fineness);
    for (const char* source : {"discretisation", "other_places"})
      row.errors.set_numerical({source, "as at all instants", full.errors.of(source)});
    take_over_model(full.errors, "as at all instants", row.errors);
    take_cost(row, own);
    for (const auto& stage : full.stages)
      if (stage.stage == "mesh" || stage.stage == "solve" || stage.stage == "write")
        row.stages.push_back(stage);
    row.seconds = total_seconds(row.stages);
    row.gigabytes = full.gigabytes;
    rows.push_back(std::move(row));
  }
}

/// What the change from a coarser mesh tells.
void learn(AccuracyRow& row, const AccuracyRow& coarser, double order) {
  const double ratio = std::cbrt(double(row.n_dofs) / double(coarser.n_dofs));
  learn_from_change(row.errors, row.value_Pa - coarser.value_Pa, ratio, 3, order);
}

/// Stress converges with first order in cells of degree 1, and beside sharp weld toes.
double stress_order(const AccuracyBench& bench, int degree) {
  return degree == 1 || bench.has_hot_spots() ? 1 : 2;
}

/// Predicted time from the run before, or where a series begins, from the last of another; 0 where nothing
/// was run.
double predicted_s(const std::optional<AccuracyRow>& before, const std::vector<AccuracyRow>& others,
                   double n_dofs) {
  if (!before && others.empty()) return 0;
  const AccuracyRow& known = before ? *before : others.back();
  return known.seconds * std::pow(n_dofs / double(known.n_dofs), growth_of_seconds);
}

void run_series(AccuracyBench& bench, const Series& series, double end_s, SolidModels& models) {
  std::optional<AccuracyRow> before;  // its budget as it says itself
  const bool refinable = can_be_refined(bench.body());
  for (const double factor : refinable ? series.factors : std::vector<double>{1}) {
    const auto name = fmt::format("{}, cells 1/{:g}", series.model, factor);
    const double dofs = double(bench.own().model->n_dofs()) * std::pow(factor * series.degree / 2, 3);
    const double predicted = predicted_s(before, models.rows, dofs), left_s = end_s - bench.elapsed_s();
    if (predicted > left_s) {
      bench.leave_out_for_time(name, predicted, left_s);
      continue;
    }
    auto body = with_fineness(bench.body(), factor);
    body.degree = series.degree;
    auto solid = bench.run_solid(series.model, name, body);
    if (!solid) continue;
    auto& row = solid->row;
    // Too little finer for whole numbers of cells?
    const bool is_known = before && before->n_dofs == row.n_dofs;
    if (!is_known) {
      const AccuracyRow plain = row;
      if (before) learn(row, *before, stress_order(bench, series.degree));
      before = plain;
      models.rows.push_back(row);
    }
    if (factor == 1 && series.degree == 2) {
      models.effects = price_effects(solid->run.analyses.front(), seconds_of(row.stages, "solve"),
                                     seconds_of(row.stages, "superpose"), evaluation_seconds(bench.scene()));
      const AccuracyRow full = models.rows.back();
      fewer_instants(bench, full, std::move(solid->run), models.rows);
    }
    if (is_known) continue;
    if (factor >= 1 && row.errors.numerical_Pa() <= bench.overkill() * row.value_Pa) return;
  }
}

bool of_hexahedra(const AccuracyBench& bench) {
  const auto* shaft = bench.body().shaft();
  return std::holds_alternative<ChamberShape>(bench.body().shape) ||
         (shaft != nullptr && shaft->keyways.empty());
}

}  // namespace

SolidModels even_meshes(AccuracyBench& bench) {
  SolidModels models;
  const double begin_s = bench.elapsed_s(), left_s = bench.seconds_left();
  for (const auto* series : {&linear, &quadratic, &cubic})
    if (series->degree == 2 || of_hexahedra(bench))
      run_series(bench, *series, begin_s + series->share_of_time * left_s, models);
  return models;
}

std::vector<AccuracyRow> refined_meshes(AccuracyBench& bench) {
  std::vector<AccuracyRow> rows;
  auto options = bench.run_options();
  options.accuracy.tolerance = bench.overkill();
  if (!can_be_refined(bench.body())) return rows;
  StageClock own;
  std::optional<SceneRun> found;
  if (!bench.is_done("refined mesh", [&] {
        options.accuracy.time_limit_s = std::max(1e-3, bench.seconds_left());
        found = bench.timed("refined meshes", [&] { return run_scene(bench.scene(), options, own); });
      }))
    return rows;
  const SceneRun& run = *found;
  if (bench.body().natural_frequencies > 0 && !run.analyses.front().vibration) {
    bench.leave_out("refined mesh", "no time was left for its natural frequencies");
    return rows;
  }
  AccuracyRow row = row_of("refined mesh", run);
  const auto last = row.errors;
  for (const auto& step : run.analyses.front().search.steps) {
    row.fineness = step.fineness;
    row.instants_per_turn = step.instants_per_turn;
    row.n_dofs = step.n_dofs;
    row.value_Pa = step.value_Pa;
    row.errors = step.errors;
    take_over_model(last, "as of the last mesh", row.errors);
    row.principal_Pa = step.principal_Pa;
    row.seconds += step.seconds;
    row.gigabytes = step.gigabytes;
    row.stages = {{"all steps so far", row.seconds, row.gigabytes}};
    rows.push_back(row);
  }
  return rows;
}

}  // namespace pipelines
