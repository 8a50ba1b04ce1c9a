#include "pipelines/study/accuracy/accuracy_bench.h"

#include <fmt/core.h>

#include <algorithm>

#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "pipelines/search/refinement/refinement.h"

namespace pipelines {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double bench_tolerance = 0.05;

}  // namespace

AccuracyBench::AccuracyBench(const Scene& scene, std::size_t body, const AccuracyOptions& options,
                             StageClock& clock)
    : scene_(scene), body_(body), options_(options), clock_(clock), start_(Clock::now()) {
  meshed_ = clock_.run("meshes", [&] { return mesh_bodies(scene_); });
  scene_ = with_effects_chosen(scene_, meshed_, negligible_share(tolerance()));
  scene_.method = Method::solid;
}

double AccuracyBench::tolerance() const {
  if (options_.tolerance > 0) return options_.tolerance;
  return scene_.accuracy.tolerance > 0 ? scene_.accuracy.tolerance : bench_tolerance;
}

double AccuracyBench::elapsed_s() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

SceneRunOptions AccuracyBench::run_options() const {
  SceneRunOptions options;
  options.n_threads = options_.n_threads;
  options.cache = false;
  options.fatigue = false;
  options.only = body_;
  options.others = meshed_;
  return options;
}

std::optional<SolidRun> AccuracyBench::run_solid(const std::string& model, const std::string& name,
                                                 const BodyScene& body) {
  Scene scene = scene_;
  scene.bodies[body_] = body;
  std::optional<SceneRun> last;
  AccuracyRow row;
  const bool done = is_done(name, [&] {
    row = repeated(name, [&] {
      StageClock own;
      last = run_scene(scene, run_options(), own);
      auto result = row_of(model, *last);
      take_cost(result, own);
      return result;
    });
  });
  if (!done) return std::nullopt;
  return SolidRun{std::move(row), std::move(*last)};
}

void AccuracyBench::leave_out_for_time(const std::string& name, double predicted_s, double left_s) {
  leave_out(name, fmt::format("it would take about {:.2g} s, and {:.2g} s are left for it", predicted_s,
                              std::max(0.0, left_s)));
}

void AccuracyBench::take_mean(AccuracyRow& row, const std::vector<double>& seconds) {
  const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
  row.spread_s = *most - *least;
  row.seconds = 0;
  for (const double s : seconds) row.seconds += s / double(seconds.size());
}

AccuracyRow row_of(const std::string& model, const SceneRun& run) {
  const auto& analysis = run.analyses.front();
  const auto stress = governing_stress(analysis);
  AccuracyRow row;
  row.model = model;
  row.fineness = fineness_text(analysis.scene);
  row.instants_per_turn = run.loaded.scene.sampling.instants_per_turn;
  row.n_dofs = analysis.responses.n_dofs;
  row.value_Pa = stress.value_Pa;
  row.principal_Pa = analysis.envelope.principal.value_Pa[analysis.principal_node];
  row.errors = stress.errors;
  return row;
}

void take_cost(AccuracyRow& row, const StageClock& clock) {
  row.stages = clock.costs();
  row.seconds = total_seconds(row.stages);
  row.gigabytes = peak_memory_gigabytes();
}

double total_seconds(const std::vector<StageCost>& stages) {
  double sum = 0;
  for (const auto& stage : stages) sum += stage.seconds;
  return sum;
}

}  // namespace pipelines
