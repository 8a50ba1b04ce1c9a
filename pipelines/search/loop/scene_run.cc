#include "pipelines/search/loop/scene_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "pipelines/base/common/refusal_of.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/load_patch.h"
#include "pipelines/judge/analysis/weld_places.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/judge/estimates/in_time.h"
#include "pipelines/judge/estimates/submodels.h"
#include "pipelines/judge/stages/analyse_body.h"
#include "pipelines/judge/stages/body_vibration.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/judge/stages/respond.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/judge/stages/start_up_stress.h"
#include "pipelines/judge/stages/superpose_body.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/axisymmetric_run.h"
#include "pipelines/search/cheap_models/beam_run.h"
#include "pipelines/search/effect_choice/effect_bounds.h"
#include "pipelines/search/effect_choice/effect_choice.h"
#include "pipelines/search/loop/after_search.h"
#include "pipelines/search/loop/duty_loads.h"
#include "pipelines/search/loop/first_model.h"
#include "pipelines/search/loop/search_judgement.h"
#include "pipelines/search/loop/search_mesh.h"
#include "pipelines/search/loop/search_state.h"
#include "pipelines/search/loop/without_mesh.h"
#include "pipelines/search/refinement/refinement.h"
#include "pipelines/search/refinement/singular_edge.h"

namespace pipelines {
namespace {

class SceneRunner {
public:
  SceneRunner(const Scene& scene, const SceneRunOptions& options, StageClock& clock)
      : options_(options), clock_(clock), start_(Clock::now()), as_read_(scene) {
    run_.scene = scene;
  }

  SceneRun run() {
    std::vector<MeshedBody> meshed;
    for (std::size_t i = 0; i < n_bodies(); ++i) {
      methods_.push_back(is_wanted(i) ? first_method(run_.scene, i, options_.accuracy.tolerance)
                                      : Method::solid);
      meshed.push_back(is_wanted(i) ? first_meshed(i) : options_.others.at(i));
      require_toes(run_.scene.bodies[i], meshed.back().mesh);
    }
    if (run_.scene.effect_choice.open)
      run_.scene = clock_.run(
          "effects", [&] { return with_effects_chosen(run_.scene, meshed, negligible_share(tolerance())); });
    load(std::move(meshed));
    const auto first_sampling = run_.scene.sampling.instants_per_turn;
    for (const auto i : wanted()) {
      run_.analyses.push_back(solve(i));
      finish(i, run_.analyses.back());
    }
    if (is_search() && !options_.only &&
        (n_bodies() > 1 || run_.scene.sampling.instants_per_turn != first_sampling))
      agree_at_last();
    for (std::size_t k = 0; options_.keep && k < run_.analyses.size(); ++k)
      if (run_.analyses[k].method == Method::axisymmetric)  // not before: later bodies may change the loads
        run_.kept_under[run_.analyses[k].scene.name + '/' + kept_responses_name(Method::axisymmetric)] =
            keep_harmonics(run_.analyses[k], options_of(options_.only.value_or(k)), clock_);
    for (auto& analysis : run_.analyses) clock_.run("zones", [&] { add_zones(run_.scene.zones, analysis); });
    for (auto& analysis : run_.analyses) add_fatigue(analysis);
    for (auto& analysis : run_.analyses) add_start_up(analysis);
    for (const auto& warning : warnings_) run_.loaded.loads.warnings.push_back(warning);
    return std::move(run_);
  }

private:
  double tolerance() const {
    if (options_.accuracy.once) return 0;
    return options_.accuracy.tolerance > 0 ? options_.accuracy.tolerance : run_.scene.accuracy.tolerance;
  }
  std::size_t n_bodies() const { return run_.scene.bodies.size(); }
  bool is_wanted(std::size_t i) const { return !options_.only || *options_.only == i; }
  std::vector<std::size_t> wanted() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < n_bodies(); ++i)
      if (is_wanted(i)) indices.push_back(i);
    return indices;
  }

  bool is_search() const { return options_.accuracy.any(); }

  /// A model that needs no cells of the whole body.
  bool is_without_mesh(std::size_t i) const {
    return methods_[i] == Method::axisymmetric || methods_[i] == Method::beam;
  }

  MeshedBody first_meshed(std::size_t i) {
    if (is_without_mesh(i))
      return clock_.run("section", [&] { return describe_revolved(run_.scene.bodies[i]); });
    return is_search() ? first_mesh_of(i) : mesh(i);
  }

  /// The body by its model; with the choice left open, by the next more expensive one where the tolerance is
  /// not met.
  BodyAnalysis solve(std::size_t i) {
    if (is_without_mesh(i)) {
      if (run_.scene.method != Method::automatic) return search_without_mesh(i);
      std::optional<BodyAnalysis> analysis;
      const auto refusal = refusal_of([&] { analysis = search_without_mesh(i); });
      if (refusal.empty()) {
        const auto stress = governing_stress(*analysis);
        const bool is_met = stress.errors.reducible_Pa() <= tolerance() * stress.value_Pa;
        if (is_met || seconds_until(end_of(i)) <= 0) return std::move(*analysis);
      }
      if (methods_[i] == Method::beam) {
        methods_[i] = Method::axisymmetric;
        return solve(i);
      }
      methods_[i] = Method::solid;
      exchange_mesh(i, first_mesh_of(i));
    }
    return is_search() ? search_mesh(i) : solve_once(i);
  }

  BodyAnalysis search_without_mesh(std::size_t i) {
    return pipelines::search_without_mesh({run_.scene,
                                           [&](Scene next) {
                                             run_.scene = std::move(next);
                                             exchange_mesh(i, MeshedBody(run_.loaded.meshed[i]));
                                           },
                                           [&] { return analyse(i); }, [&] { return seconds_since(start_); }},
                                          i, tolerance(), end_of(i));
  }

  MeshedBody mesh(std::size_t i) { return mesh(run_.scene, run_.scene.bodies[i], nullptr); }
  /// @param coarse  the same mesh with fewer refinements; null: none is there
  MeshedBody mesh(const Scene& scene, const BodyScene& body, const MeshedBody* coarse) {
    return clock_.run("mesh", [&] { return mesh_body(body, springs_of(scene), coarse); });
  }

  void load(std::vector<MeshedBody> meshed) {
    run_.loaded = load_bodies(run_.scene, std::move(meshed), clock_);
    if (options_.duty) add_channels_of_blocks(as_read_, run_.scene, run_.loaded, clock_);
    run_.start_up = load_start_up(run_.scene, run_.loaded, clock_);
  }

  RunOptions options_of(std::size_t i) const {
    return {options_.directory / run_.scene.bodies[i].name, options_.n_threads, options_.fresh,
            is_search() && is_refined_locally(run_.scene.bodies[i])};
  }

  BodyAnalysis analyse(std::size_t i) {
    if (methods_[i] == Method::axisymmetric)
      return analyse_axisymmetric(run_.scene, run_.scene.bodies[i], run_.loaded.meshed[i],
                                  run_.loaded.body_loads[i], options_of(i), clock_, tolerance(),
                                  seconds_until(end_of(i)));
    if (methods_[i] == Method::beam) {
      auto analysis = analyse_beam(run_.scene.bodies[i], run_.loaded.meshed[i], run_.loaded.body_loads[i],
                                   options_of(i), clock_);
      if (tolerance() > 0) analysis.search = search_of_beam(run_.scene, i, analysis, tolerance());
      return analysis;
    }
    return analyse_body(run_.scene.bodies[i], run_.loaded.meshed[i], run_.loaded.body_loads[i], options_of(i),
                        clock_);
  }

  void finish(std::size_t i, BodyAnalysis& analysis) {
    if (options_.keep && !is_without_mesh(i))
      run_.kept_under[run_.scene.bodies[i].name + '/' + kept_responses_name(Method::solid)] =
          keep_responses(run_.scene.bodies[i], run_.loaded.meshed[i], analysis, options_of(i), clock_);
    auto warnings = add_frequencies(run_.scene, run_.loaded.meshed[i], run_.loaded.loads, seconds_to_finish(),
                                    analysis, clock_);
    warnings.push_back(warning_of_covered(analysis.scene.name, run_.loaded.meshed[i].mesh));
    for (auto& warning : warnings)
      if (!warning.empty()) warnings_.push_back(warning);
    clock_.run("superpose", [&] { bound_dropped_effects(run_.scene, i, run_.loaded, analysis); });
    run_.loaded.meshed[i].model.reset();
  }

  /// Fatigue, where the scene asks for it; operating blocks need it, however long it takes.
  void add_fatigue(BodyAnalysis& analysis) {
    if (!analysis.scene.fatigue || !options_.fatigue) return;
    for (auto& warning :
         pipelines::add_fatigue(run_.scene, run_.loaded.loads, options_.duty ? never : seconds_to_finish(),
                                options_.n_threads, analysis, clock_))
      warnings_.push_back(std::move(warning));
  }

  /// The start, where the scene asks for it, on the final responses.
  void add_start_up(BodyAnalysis& analysis) {
    if (!run_.start_up) return;
    clock_.run("start-up", [&] {
      analysis.start_up = std::make_shared<const StartUpStress>(
          start_up_stress(analysis, *run_.start_up, run_.loaded.loads, threads(options_.n_threads)));
    });
  }

  MeshedBody first_mesh_of(std::size_t i) {
    const double end_s = end_of(i);
    auto [body, meshed] = first_mesh(
        run_.scene.bodies[i],
        [&](const BodyScene& candidate) { return mesh(run_.scene, candidate, nullptr); },
        [&] { return seconds_until(end_s); });
    run_.scene.bodies[i] = std::move(body);
    return std::move(meshed);
  }

  /// The submodels that tell them may take longer than the solution.
  /// @param end_s  of the submodels; 0: never
  std::vector<PlaceStress> errors_of_places(const BodyAnalysis& analysis, double end_s) {
    const double seconds = n_ranks_of_a_body() > 1 ? never : std::max(1e-3, seconds_until(end_s));
    return clock_.run("errors", [&] { return places_of_one_mesh(analysis, seconds); });
  }

  /// The scene's own mesh.
  BodyAnalysis solve_once(std::size_t i) {
    auto analysis = analyse(i);
    PlaceHistory history(mesh_parts(run_.scene.bodies[i]));
    history.add(errors_of_places(analysis, 0), std::nullopt);
    take_place_errors(analysis, history.judged(),
                      analysis.responses.nodes.shape().is_tetrahedron()
                          ? submodel_method
                          : "single cells around, times a safety factor of 3");
    return analysis;
  }

  /// None, too, where it would take more than half of the time that is left.
  std::optional<SecondModel> second_model(std::size_t i, const SearchState& state) {
    if (!options_.second_model) return std::nullopt;
    return clock_.run("second model", [&] {
      return second_model_of(run_.scene.bodies[i], run_.loaded.meshed[i], run_.loaded.body_loads[i],
                             tolerance(), options_.n_threads, seconds_until(state.end_s) / 2);
    });
  }

  /// What is left of the time, shared evenly among the bodies that wait.
  double end_of(std::size_t i) const {
    const double limit_s = options_.accuracy.time_limit_s, now_s = seconds_since(start_);
    if (limit_s <= 0) return 0;
    const auto bodies = wanted();
    const auto waiting = std::count_if(bodies.begin(), bodies.end(), [&](std::size_t b) { return b >= i; });
    return std::max(1e-3, now_s + (limit_s - now_s) / double(waiting));
  }

  /// A second model tells a shaft's mesh where to be fine.
  void guide(std::size_t i, SearchState& state) {
    auto model = second_model(i, state);
    state.second_model_s = seconds_since(state.step_start);
    if (model) {
      const Scene unguided = run_.scene;
      run_.scene.bodies[i] = guided_by(*model, run_.scene.bodies[i]);
      state.history.compare_with(std::move(*model));
      std::optional<MeshedBody> guided;
      if (refusal_of([&] { guided = mesh(i); }).empty())
        exchange_mesh(i, std::move(*guided));
      else
        run_.scene = unguided;
    }
  }

  /// Finer cells lock less, so that stress grows with them where nothing is sharp.
  static bool is_locking(const GoverningStress& stress) {
    constexpr double locked_share = 0.1;
    return stress.errors.of("locking") > locked_share * stress.value_Pa;
  }

  /// Enters the present mesh into what is known.
  void take_stock(std::size_t i, SearchState& state, BodyAnalysis& analysis) {
    const bool grows = state.growth.at(analysis, state.step ? state.step->ratio : 1);
    if (grows && !is_locking(governing_stress(analysis))) leave_out(i, analysis);
    state.history.add(errors_of_places(analysis, state.end_s), state.step);
    judge_places(run_.loaded.meshed[i], state, analysis, clock_);
    const auto stress = governing_stress(analysis);
    state.search.quantity = stress.name();
    state.search.steps.push_back(step_of(run_.scene, i, stress, analysis, seconds_since(state.step_start)));
    clock_.note(text_of_step(analysis.scene.name, state.search));
    state.search.steps.back().refined = state.step ? to_string(state.step->part) : "";
    state.search.met = is_met(state.search, stress);
  }

  /// Runs body i until its governing stress is good enough, or nothing more can be done.
  BodyAnalysis search_mesh(std::size_t i) {
    SearchState state(run_.scene.bodies[i]);
    state.search.tolerance = options_.accuracy.tolerance;
    state.search.time_limit_s = options_.accuracy.time_limit_s;
    state.end_s = end_of(i);
    guide(i, state);
    BodyAnalysis analysis = analyse(i);
    while (true) {
      take_stock(i, state, analysis);
      const auto ended = [&] {
        return reason_to_end(state.search, governing_stress(analysis), is_block_shaft(analysis.scene));
      };
      state.search.ended = ended();
      if (!state.search.ended.empty()) {
        judge_other_places(run_.loaded.meshed[i], state, analysis, clock_);
        state.search.ended = ended();
      }
      if (!state.search.ended.empty() || !next_step(i, state, analysis)) break;
    }
    judge_other_places(run_.loaded.meshed[i], state, analysis, clock_);
    const auto& first = state.search.steps.front();
    const auto overrun = warning_of_overrun(run_.scene.bodies[i], state.search.steps.size(), first.n_dofs,
                                            state.end_s, seconds_since(start_));
    if (!overrun.empty()) warnings_.push_back(overrun);
    analysis.search = std::move(state.search);
    return analysis;
  }

  /// Takes the step that promises most.
  /// @return false if none can be taken: search.ended says why
  bool next_step(std::size_t i, SearchState& state, BodyAnalysis& analysis) {
    state.step_start = Clock::now();
    const double seconds_before =
        state.search.steps.back().seconds - std::exchange(state.second_model_s, 0.0);
    Scene next = run_.scene;
    next.bodies[i].felt_seats.merge(felt_seats(analysis));
    const auto other =
        refine_sampling_and_harmonics(next, i, governing_stress(analysis), analysis.loads.history);
    if (other.possible && !other.mesh_matters) {
      state.step.reset();
      return take(std::move(next), i, run_.loaded.meshed[i], state, analysis, seconds_before);
    }
    const auto judged = analysis.place_stresses;
    const auto& target = judged[judge(judged).holding_back].feature;
    std::string refusal;
    for (const auto part : state.history.by_promise(target)) {
      if (state.exhausted.count(part)) continue;
      Scene finer = next;
      const bool is_local = part == MeshPart::local;
      auto step = is_local ? refine_locally(finer.bodies[i], state.local)
                           : refine_mesh(finer.bodies[i], analysis, judged, part);
      if (!step) continue;
      // A finer mesh would not be solved in less than this one.
      const auto seconds_left = [&] { return seconds_until(state.end_s) - seconds_before; };
      const auto* coarse = is_local ? &run_.loaded.meshed[i] : nullptr;
      const auto make = [&](BodyScene& body) {
        return mesh_refined(body, [&] { return mesh(finer, body, coarse); });
      };
      std::optional<SearchMesh> found;
      if (seconds_left() >= 0)
        in_time(seconds_until(state.end_s),
                [&] { found = finer_mesh(finer.bodies[i], make, seconds_left, refusal); });
      if (!found && !(seconds_left() >= 0)) {
        state.search.next_seconds = seconds_before;  // at least
        state.search.ended = time_is_up;
        return false;
      }
      if (!found) {
        state.exhausted.insert(part);
        continue;
      }
      state.step = std::move(step);
      finer.bodies[i] = std::move(found->body);
      return take(std::move(finer), i, std::move(found->meshed), state, analysis, seconds_before);
    }
    state.search.ended = "the mesh cannot be refined further" + (refusal.empty() ? "" : ": " + refusal);
    return false;
  }

  static constexpr double never = std::numeric_limits<double>::infinity();

  /// Infinite without a limit.
  double seconds_until(double end_s) const { return end_s > 0 ? end_s - seconds_since(start_) : never; }

  /// For what comes after a search: a tenth of a limit that was asked for, at least.
  double seconds_to_finish() const {
    constexpr double share = 0.1;
    const double limit_s = options_.accuracy.by_default ? 0 : options_.accuracy.time_limit_s;
    return std::max(share * limit_s, seconds_until(limit_s));
  }

  /// A stress that grows with every refinement has no peak to report: its place joins the sharp edges, which
  /// are left out by a distance fixed in the geometry, and the search goes on for the rest. The whole edge is
  /// left out: else the peak would only move along it. Where there is no edge, nothing is.
  void leave_out(std::size_t i, BodyAnalysis& analysis) {
    const auto found = edge_without_bound(analysis);
    if (!found) return;
    warnings_.push_back(found->warning);
    run_.scene.bodies[i].singular.push_back(found->edge);
    run_.loaded.meshed[i].mesh.sharp_edges.push_back(found->edge);
    BodyAnalysis before = std::move(analysis);
    analysis = superposed_again(i, before);
  }

  /// Under its present loads.
  BodyAnalysis superposed_again(std::size_t i, BodyAnalysis& before) {
    return superpose_again(run_.scene.bodies[i], run_.loaded.meshed[i], run_.loaded.body_loads[i], before,
                           !options_of(i).keep_factor, options_.n_threads, clock_);
  }

  /// Solves the next version of the scene, unless that would not end in time or does not fit into memory.
  bool take(Scene next, std::size_t i, MeshedBody finer, SearchState& state, BodyAnalysis& analysis,
            double seconds_before) {
    auto& search = state.search;
    const double growth = double(finer.model->n_dofs()) / double(analysis.responses.n_dofs);
    search.next_seconds = seconds_before * std::pow(growth, growth_of_seconds);
    const double left_s =
        seconds_until(state.end_s) - seconds_of_frequencies(run_.scene.bodies[i], finer.model->n_dofs());
    if (search.next_seconds > left_s) {
      search.ended = time_is_up;
      return false;
    }
    // The mesh to return to; a factor that it holds takes memory, and is kept where it may be needed.
    std::optional<MeshedBody> before;
    if (std::isfinite(left_s) && (!options_of(i).keep_factor || 2 * search.next_seconds > left_s))
      before = run_.loaded.meshed[i];
    const Scene previous = std::exchange(run_.scene, std::move(next));
    exchange_mesh(i, std::move(finer));
    const auto return_to_mesh = [&](const std::string& ended) {
      search.ended = ended;
      run_.scene = previous;
      exchange_mesh(i, before ? std::move(*before) : mesh(i));
      return false;
    };
    const auto without_finer_mesh = [&](const std::string& why) {
      return return_to_mesh("a finer mesh could not be solved: " + why);
    };
    try {
      if (!in_time(seconds_until(state.end_s), [&] { analysis = analyse(i); }))
        return return_to_mesh(time_is_up);
    } catch (const fem::DoesNotFit& error) {
      return without_finer_mesh(error.what());
    } catch (const std::bad_alloc&) {  // what is taken beside the solver's own
      return without_finer_mesh("it does not fit into memory");
    }
    const bool same_loads = previous.sampling.instants_per_turn == run_.scene.sampling.instants_per_turn &&
                            previous.bodies[i].pressure_harmonics == run_.scene.bodies[i].pressure_harmonics;
    if (!same_loads && state.history.second_model()) {
      const auto start = Clock::now();
      if (auto model = second_model(i, state)) state.history.compare_with(std::move(*model));
      state.second_model_s = seconds_since(start);
    }
    return true;
  }

  /// Loads all bodies anew, one of them on another mesh.
  void exchange_mesh(std::size_t i, MeshedBody other) {
    auto meshed = std::move(run_.loaded.meshed);
    meshed[i] = std::move(other);
    load(std::move(meshed));
  }

  /// Masses and instants may have changed after a body was done: its loads are computed and superposed again,
  /// with the responses it has. A model without a mesh of its own is solved again.
  void agree_at_last() {
    auto meshed = std::move(run_.loaded.meshed);
    load(std::move(meshed));
    for (std::size_t i = 0; i < n_bodies(); ++i) {
      if (is_without_mesh(i)) {  // cheap, and its errors follow from its own steps
        auto steps = std::move(run_.analyses[i].search.steps);
        run_.analyses[i] = analyse(i);
        const auto n_own = run_.analyses[i].search.steps.size();
        steps.resize(steps.size() -
                     std::min(steps.size(), n_own));  // the last ones are those of the same scene
        prepend_steps(std::move(steps), run_.analyses[i].search);
        bound_dropped_effects(run_.scene, i, run_.loaded, run_.analyses[i]);
        continue;
      }
      BodyAnalysis before = std::move(run_.analyses[i]);
      auto& after = run_.analyses[i];
      after = superposed_again(i, before);
      after.search = std::move(before.search);
      after.vibration = std::move(before.vibration);
      enter_vibration(after);
      take_torsion_by_harmonics(before, after);
      take_place_errors(after, before.place_stresses, "as found by the body's search");
      bound_dropped_effects(run_.scene, i, run_.loaded, after);
    }
  }

  SceneRunOptions options_;
  StageClock& clock_;
  Clock::time_point start_;
  Scene as_read_;
  SceneRun run_;
  std::vector<Method> methods_;  // by body
  std::vector<std::string> warnings_;
};

}  // namespace

SceneRun run_scene(const Scene& scene, const SceneRunOptions& options, StageClock& clock) {
  Scene with_choice = scene;
  while (true) {
    SceneRun run = SceneRunner(with_choice, options, clock).run();
    const auto back = effect_to_take_back(run.scene, run.analyses);
    if (back.empty()) return run;
    with_choice.effects = run.scene.effects;
    with_choice.effect_choice = run.scene.effect_choice;
    with_choice = with_effect_back(with_choice, back);
  }
}

}  // namespace pipelines
