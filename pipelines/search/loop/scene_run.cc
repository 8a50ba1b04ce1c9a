#include "pipelines/search/loop/scene_run.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "pipelines/base/common/refusal_of.h"
#include "pipelines/judge/analysis/weld_places.h"
#include "pipelines/judge/stages/judge_body.h"
#include "pipelines/judge/stages/start_up_stress.h"
#include "pipelines/loads/stage/start_up_loads.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/effect_choice/effect_bounds.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "pipelines/search/loop/after_search.h"
#include "pipelines/search/loop/duty_loads.h"
#include "pipelines/search/loop/search.h"
#include "pipelines/search/models/first_method.h"
#include "pipelines/search/models/search_mesh.h"
#include "pipelines/search/refinement/local_refinement.h"
#include "pipelines/search/refinement/refinement.h"

namespace pipelines {
namespace {

/// One run of a scene whose effects are chosen, or are chosen by its first meshes.
class SceneRunner {
public:
  SceneRunner(const Scene& scene, const SceneRunOptions& options, StageClock& clock)
      : as_read_(scene), options_(options), clock_(clock) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (!options.only || *options.only == i) wanted_.push_back(i);
  }

  SceneRun run() {
    load_first_meshes();
    const int first_instants = loaded_.scene.sampling.instants_per_turn;
    for (const auto i : wanted_) search_body(i);
    if (is_search() && !options_.only &&
        (wanted_.size() > 1 || loaded_.scene.sampling.instants_per_turn != first_instants))
      agree_about_loads();
    for (auto& judged : judged_) clock_.run("zones", [&] { add_zones(loaded_.scene.zones, judged); });
    for (auto& judged : judged_) judge_fatigue_of(judged);
    for (auto& judged : judged_) superpose_start(judged);
    for (const auto& warning : warnings_) loaded_.loads.warnings.push_back(warning);
    SceneRun result;
    result.loaded = std::move(loaded_);
    result.analyses = std::move(judged_);
    result.kept = std::move(kept_);
    return result;
  }

private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  bool is_search() const { return options_.accuracy.any(); }
  bool is_wanted(std::size_t i) const { return std::count(wanted_.begin(), wanted_.end(), i) > 0; }

  double tolerance() const {
    if (options_.accuracy.once) return 0;
    return options_.accuracy.tolerance > 0 ? options_.accuracy.tolerance : as_read_.accuracy.tolerance;
  }

  /// When the time of a body is up: what is left is shared evenly among the bodies that wait.
  double end_of(std::size_t i) const {
    const double limit_s = options_.accuracy.time_limit_s, now_s = time_.seconds();
    if (limit_s <= 0) return 0;
    const auto waiting = std::count_if(wanted_.begin(), wanted_.end(), [&](auto b) { return b >= i; });
    return std::max(1e-3, now_s + (limit_s - now_s) / double(waiting));
  }

  /// For what comes after the searches: a tenth of a limit that was asked for, at least.
  double seconds_to_finish() const {
    constexpr double share = 0.1;
    const double limit_s = options_.accuracy.by_default ? 0 : options_.accuracy.time_limit_s;
    return std::max(share * limit_s, time_.seconds_until(limit_s));
  }

  RunOfBody run_of(std::size_t i) {
    const auto& body = as_read_.bodies[i];
    RunOfBody run;
    run.index = i;
    run.options = {options_.n_threads, options_.fresh || !options_.cache,
                   is_search() && is_refined_locally(body)};
    run.is_search = is_search();
    run.has_second_model = options_.second_model;
    run.tolerance = tolerance();
    run.time_limit_s = options_.accuracy.time_limit_s;
    run.end_s = end_of(i);
    run.time = time_;
    run.clock = &clock_;
    run.load = [this](const Scene& scene, std::vector<MeshedBody> meshed) {
      return load(scene, std::move(meshed));
    };
    run.warn = [this](const std::string& warning) { warn(warning); };
    return run;
  }

  /// The steady loads, with the channels that blocks and a start have besides.
  Loaded load(const Scene& scene, std::vector<MeshedBody> meshed) {
    auto loaded = load_bodies(scene, std::move(meshed), clock_);
    if (options_.duty) add_channels_of_blocks(as_read_, scene, loaded, clock_);
    loaded.start_up = load_start_up(scene, loaded, clock_);
    return loaded;
  }

  void load_first_meshes() {
    Scene scene = as_read_;
    std::vector<MeshedBody> meshed;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      methods_.push_back(is_wanted(i) ? first_method(scene, i, tolerance()) : Method::solid);
      meshed.push_back(is_wanted(i) ? first_mesh_of(scene, i) : options_.others.at(i));
      require_toes(scene.bodies[i], meshed.back().mesh);
    }
    if (scene.effect_choice.open)
      scene = clock_.run("effects",
                         [&] { return with_effects_chosen(scene, meshed, negligible_share(tolerance())); });
    loaded_ = load(scene, std::move(meshed));
  }

  /// By the method of the body; a search begins with a coarser mesh than the scene's.
  MeshedBody first_mesh_of(Scene& scene, std::size_t i) {
    auto& body = scene.bodies[i];
    if (is_without_mesh(methods_[i])) return clock_.run("section", [&] { return describe_revolved(body); });
    if (!is_search()) return mesh_in_stage(scene, body, nullptr, clock_);
    const double end_s = end_of(i);
    auto found = first_mesh(
        body, [&](const BodyScene& candidate) { return mesh_in_stage(scene, candidate, nullptr, clock_); },
        [&] { return time_.seconds_until(end_s); });
    body = std::move(found.body);
    return std::move(found.meshed);
  }

  void search_body(std::size_t i) {
    judged_.push_back(solve(i));
    finish(i, judged_.back());
  }

  /// The body by its model; with the choice left open, by the next more expensive one where that is refused
  /// or does not meet the tolerance.
  Judged solve(std::size_t i) {
    while (is_without_mesh(methods_[i]) && loaded_.scene.method == Method::automatic) {
      std::optional<Judged> judged;
      const bool is_refused = !refusal_of([&] { judged = solve_by_method(i); }).empty();
      if (!is_refused && (judged->search.met || time_.seconds_until(end_of(i)) <= 0))
        return std::move(*judged);
      methods_[i] = after(methods_[i]);
      if (is_without_mesh(methods_[i])) continue;
      Scene scene = loaded_.scene;
      auto meshed = std::move(loaded_.meshed);
      meshed[i] = first_mesh_of(scene, i);
      loaded_ = load(scene, std::move(meshed));
    }
    return solve_by_method(i);
  }

  Judged solve_by_method(std::size_t i) {
    const auto run = run_of(i);
    auto model = model_of(methods_[i], run, loaded_);
    Judged judged;
    if (is_search() || is_without_mesh(methods_[i])) {
      judged = search(model, run);
    } else {
      judged = model->solve();
      model->judge(judged);
    }
    if (!is_search() && tolerance() == 0) judged.search = {};
    loaded_ = model->loaded();
    warn(warning_of_overrun(loaded_.scene.bodies[i], judged.search, run.end_s, time_.seconds()));
    return judged;
  }

  /// An empty one is none.
  void warn(const std::string& warning) {
    if (!warning.empty()) warnings_.push_back(warning);
  }

  void finish(std::size_t i, Judged& judged) {
    auto& meshed = loaded_.meshed[i];
    if (options_.cache && !is_without_mesh(methods_[i]))
      kept_.keep(judged, key_of_responses(loaded_.scene.bodies[i], meshed, judged.loads, run_of(i).options),
                 clock_);
    for (const auto& warning :
         add_frequencies(loaded_.scene, meshed, loaded_.loads, seconds_to_finish(), judged, clock_))
      warn(warning);
    warn(warning_of_covered(judged.scene.name, meshed.mesh));
    clock_.run("superpose", [&] { bound_dropped_effects(loaded_, i, judged); });
    meshed.model.reset();
  }

  /// Masses and instants may have changed after a body was searched: its loads are computed and superposed
  /// again, with the responses it has.
  void agree_about_loads() {
    loaded_ = load(Scene(loaded_.scene), std::move(loaded_.meshed));
    for (std::size_t i = 0; i < judged_.size(); ++i) {
      judged_[i] = model_of(methods_[i], run_of(i), loaded_)->again(judged_[i]);
      bound_dropped_effects(loaded_, i, judged_[i]);
    }
  }

  /// Where the scene asks for it; operating blocks need it, however long it takes.
  void judge_fatigue_of(Judged& judged) {
    if (!judged.scene.fatigue || !options_.fatigue) return;
    for (const auto& warning :
         add_fatigue(loaded_.scene, loaded_.loads, options_.duty ? never : seconds_to_finish(),
                     options_.n_threads, judged, clock_))
      warn(warning);
  }

  /// Where the scene asks for it, on the final responses.
  void superpose_start(Judged& judged) {
    if (!loaded_.start_up) return;
    clock_.run("start-up", [&] {
      judged.start_up = std::make_shared<const StartUpStress>(
          start_up_stress(judged, *loaded_.start_up, loaded_.loads, threads(options_.n_threads)));
    });
  }

  const Scene& as_read_;
  const SceneRunOptions& options_;
  StageClock& clock_;
  RunTime time_;
  std::vector<std::size_t> wanted_;  ///< bodies, by index
  std::vector<Method> methods_;      ///< by body
  Loaded loaded_;
  std::vector<Judged> judged_;  ///< the wanted bodies
  KeptResponses kept_;
  std::vector<std::string> warnings_;
};

}  // namespace

SceneRun run_scene(const Scene& scene, const SceneRunOptions& options, StageClock& clock) {
  Scene with_choice = scene;
  while (true) {
    SceneRun run = SceneRunner(with_choice, options, clock).run();
    const auto back = effect_to_take_back(run.loaded.scene, run.analyses);
    if (back.empty()) return run;
    with_choice.effects = run.loaded.scene.effects;
    with_choice.effect_choice = run.loaded.scene.effect_choice;
    with_choice = with_effect_back(with_choice, back);
  }
}

}  // namespace pipelines
