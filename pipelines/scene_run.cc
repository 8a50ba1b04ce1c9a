#include "pipelines/scene_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include "pipelines/atomic_file.h"
#include "pipelines/effect_bounds.h"
#include "pipelines/effect_choice.h"
#include "pipelines/fineness.h"
#include "pipelines/peak_growth.h"
#include "pipelines/refinement.h"
#include "pipelines/singular_edge.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int most_steps = 12;
constexpr double share_left_out = 0.01;  // of the body's diagonal, as for imported bodies' edges
/// A step is taken if it is predicted to end in time; predictions are rough.
constexpr double growth_of_seconds = 1.5;  // with the number of unknowns, for the direct solver

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What becomes the mesh of one body.
class BodyFiles {
public:
  explicit BodyFiles(const fs::path& directory)
      : directory_(directory), mesh_(std::make_unique<AtomicFile>(directory / "mesh.msh")) {}

  const fs::path& mesh() const { return mesh_->temporary(); }

  /// The mesh gets its name.
  void finish(BodyAnalysis& analysis, MeshedBody& meshed) {
    mesh_->commit();
    analysis.mesh.file = meshed.mesh.file = meshed.body.mesh = directory_ / "mesh.msh";
  }

private:
  fs::path directory_;
  std::unique_ptr<AtomicFile> mesh_;
};

class SceneRunner {
public:
  SceneRunner(const Scene& scene, const SceneRunOptions& options, StageClock& clock)
      : options_(options), clock_(clock), start_(Clock::now()) {
    run_.scene = scene;
    for (const auto& body : scene.bodies) files_.emplace_back(options.directory / body.name);
  }

  SceneRun run() {
    const bool search = options_.wish.any();
    if (search)
      for (const auto i : wanted()) run_.scene.bodies[i] = coarsest(run_.scene.bodies[i]);
    std::vector<MeshedBody> meshed;
    for (std::size_t i = 0; i < n_bodies(); ++i)
      meshed.push_back(is_wanted(i) ? mesh(i) : options_.others.at(i));
    if (run_.scene.effect_choice.open)
      run_.scene = clock_.run(
          "effects", [&] { return with_effects_chosen(run_.scene, meshed, negligible_share(tolerance())); });
    load(std::move(meshed));
    const auto first_sampling = run_.scene.sampling.instants_per_turn;
    for (const auto i : wanted()) {
      run_.analyses.push_back(search ? search_mesh(i) : analyse(i));
      finish(i, run_.analyses.back());
    }
    if (search && !options_.only &&
        (n_bodies() > 1 || run_.scene.sampling.instants_per_turn != first_sampling))
      agree_at_last();
    for (const auto& warning : warnings_) run_.loaded.loads.warnings.push_back(warning);
    return std::move(run_);
  }

private:
  double tolerance() const {
    return options_.wish.tolerance > 0 ? options_.wish.tolerance : run_.scene.wish.tolerance;
  }
  std::size_t n_bodies() const { return run_.scene.bodies.size(); }
  bool is_wanted(std::size_t i) const { return !options_.only || *options_.only == i; }
  std::vector<std::size_t> wanted() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < n_bodies(); ++i)
      if (is_wanted(i)) indices.push_back(i);
    return indices;
  }

  MeshedBody mesh(std::size_t i) {
    return clock_.run(
        "mesh", [&] { return mesh_body(run_.scene.bodies[i], files_[i].mesh(), springs_of(run_.scene)); });
  }

  void load(std::vector<MeshedBody> meshed) {
    run_.loaded = load_bodies(run_.scene, std::move(meshed), clock_);
  }

  RunOptions options_of(std::size_t i) const {
    return {options_.directory / run_.scene.bodies[i].name, options_.n_threads, options_.fresh};
  }

  BodyAnalysis analyse(std::size_t i) {
    return analyse_body(run_.scene, run_.scene.bodies[i], run_.loaded.meshed[i], run_.loaded.body_loads[i],
                        options_of(i), clock_);
  }

  void finish(std::size_t i, BodyAnalysis& analysis) {
    if (options_.keep)
      keep_responses(run_.scene.bodies[i], run_.loaded.meshed[i], analysis, options_of(i), clock_);
    add_vibration(run_.scene, run_.loaded.meshed[i], run_.loaded.loads, analysis, clock_);
    if (analysis.vibration)
      if (const auto warning = warning_of(analysis.scene, *analysis.vibration); !warning.empty())
        warnings_.push_back(warning);
    clock_.run("superpose", [&] { bound_dropped_effects(run_.scene, i, run_.loaded, analysis); });
    files_[i].finish(analysis, run_.loaded.meshed[i]);
    run_.loaded.meshed[i].model.reset();
  }

  SearchStep record(std::size_t i, const GoverningStress& stress, const BodyAnalysis& analysis,
                    double seconds) const {
    return {fineness_text(run_.scene.bodies[i]),
            run_.scene.sampling.instants_per_turn,
            run_.scene.bodies[i].pressure_harmonics,
            analysis.responses.n_dofs,
            stress.value_Pa,
            stress.errors,
            analysis.envelope.principal.value_Pa[analysis.principal_node],
            seconds,
            peak_memory_gigabytes()};
  }

  /// Why no further step is taken; empty: one is.
  std::string reason_to_end(const Search& search, const GoverningStress& stress) const {
    if (search.tolerance > 0 && stress.relative_error() <= search.tolerance) return "the tolerance is met";
    if (stress.value_Pa == 0) return "nothing is stressed";
    if (int(search.steps.size()) >= most_steps) return "too many steps";
    return {};
  }

  /// Runs body i until its governing stress is good enough, or nothing more can be done.
  BodyAnalysis search_mesh(std::size_t i) {
    Search search;
    search.tolerance = options_.wish.tolerance;
    search.time_limit_s = options_.wish.time_limit_s;
    auto step_start = Clock::now();
    BodyAnalysis analysis = analyse(i);
    double ratio = 1, order = 2, before_Pa = 0;
    bool new_mesh = true;
    int n_meshes = 1;
    MeshPart part = MeshPart::all;
    Remainders known;
    PeakGrowth growth;
    while (true) {
      const bool elsewhere = growth.at(analysis, ratio);
      if (elsewhere) leave_out(i, analysis);
      auto stress = governing_stress(analysis);
      if (!search.steps.empty() && !new_mesh && !elsewhere)
        keep_discretisation(stress.errors, search.steps.back().errors);
      else if (!search.steps.empty())
        known.learn(part, learn_from_change(stress.errors, stress.value_Pa - before_Pa, ratio, ++n_meshes,
                                            order, known.of_others(part)));
      set_errors(analysis, stress.errors);
      const double seconds = seconds_since(step_start);
      search.quantity = stress.name;
      search.steps.push_back(record(i, stress, analysis, seconds));
      search.ended = reason_to_end(search, stress);
      if (!search.ended.empty()) break;

      step_start = Clock::now();
      before_Pa = stress.value_Pa;
      Scene next = run_.scene;
      const auto refinement = refine(next, i, analysis, known);
      if (!refinement.possible) {
        search.ended = "the mesh cannot be refined further";
        break;
      }
      ratio = refinement.ratio;
      order = refinement.order;
      new_mesh = refinement.new_mesh;
      part = refinement.part;
      if (!take(std::move(next), i, refinement, search, analysis, seconds)) break;
    }
    search.met = search.tolerance == 0 || governing_stress(analysis).relative_error() <= search.tolerance;
    analysis.search = std::move(search);
    return analysis;
  }

  /// A stress that grows with every refinement has no peak to report: its place joins the sharp edges, which
  /// are left out by a distance fixed in the geometry, and the search goes on for the rest. On a concave edge
  /// the whole edge is left out: else the peak would only move along it.
  void leave_out(std::size_t i, BodyAnalysis& analysis) {
    const auto& p = analysis.peak.position_m;
    const auto& nodes = analysis.responses.nodes;
    const double distance_m = share_left_out * diagonal_m(nodes);
    auto edge = concave_edge_through(nodes, analysis.peak.node, distance_m);
    const bool is_edge = !edge.empty();
    if (!is_edge) edge = {{p, p}};
    const meshes::SharpEdge spot{"stress grows without bound at " + analysis.peak.feature, distance_m,
                                 std::move(edge)};
    warnings_.push_back(
        fmt::format("{}: the stress at {} grows with every refinement, like at a sharp corner: {:.2g} mm "
                    "around {}({:.1f}, "
                    "{:.1f}, {:.1f}) mm are left out of the peak",
                    analysis.scene.name, analysis.peak.feature, 1e3 * spot.distance_m,
                    is_edge ? "the edge at " : "", 1e3 * p[0], 1e3 * p[1], 1e3 * p[2]));
    run_.scene.bodies[i].singular.push_back(spot);
    run_.loaded.meshed[i].mesh.sharp_edges.push_back(spot);
    BodyAnalysis before = std::move(analysis);
    analysis =
        superpose_body(run_.scene, run_.scene.bodies[i], run_.loaded.meshed[i], run_.loaded.body_loads[i],
                       std::move(before.responses), options_.n_threads, clock_);
    analysis.responses_reused = before.responses_reused;
  }

  /// Takes the next step, unless it would not end in time or cannot be meshed or solved.
  bool take(Scene next, std::size_t i, const Refinement& refinement, Search& search, BodyAnalysis& analysis,
            double seconds_before) {
    const Scene previous = std::exchange(run_.scene, std::move(next));
    MeshedBody finer = run_.loaded.meshed[i];
    if (refinement.new_mesh) {
      try {
        finer = mesh(i);
      } catch (const std::runtime_error& error) {
        run_.scene = previous;
        search.ended = std::string("a finer mesh failed: ") + error.what();
        return false;
      }
    }
    const double growth = double(finer.model->n_dofs()) / double(analysis.responses.n_dofs);
    search.next_seconds = seconds_before * std::pow(growth, growth_of_seconds);
    if (search.time_limit_s > 0 && seconds_since(start_) + search.next_seconds > search.time_limit_s) {
      run_.scene = previous;
      search.ended = "the time is up";
      if (refinement.new_mesh) run_.loaded.meshed[i] = mesh(i);
      return false;
    }
    exchange_mesh(i, std::move(finer));
    try {
      analysis = analyse(i);
    } catch (const fem::DoesNotFit& error) {
      search.ended = std::string("a finer mesh could not be solved: ") + error.what();
      run_.scene = previous;
      exchange_mesh(i, refinement.new_mesh ? mesh(i) : MeshedBody(run_.loaded.meshed[i]));
      return false;
    }
    return true;
  }

  /// Loads all bodies anew, one of them on another mesh.
  void exchange_mesh(std::size_t i, MeshedBody other) {
    auto meshed = std::move(run_.loaded.meshed);
    meshed[i] = std::move(other);
    load(std::move(meshed));
  }

  static void set_errors(BodyAnalysis& analysis, const ErrorLedger& errors) {
    (analysis.hot_spots.empty() ? analysis.peak.errors : analysis.hot_spot_errors) = errors;
  }

  /// Masses and instants may have changed after a body was done: its loads are computed and superposed again,
  /// with the responses it has.
  void agree_at_last() {
    auto meshed = std::move(run_.loaded.meshed);
    load(std::move(meshed));
    for (std::size_t i = 0; i < n_bodies(); ++i) {
      BodyAnalysis before = std::move(run_.analyses[i]);
      const auto errors = governing_stress(before).errors;
      auto& after = run_.analyses[i];
      after =
          superpose_body(run_.scene, run_.scene.bodies[i], run_.loaded.meshed[i], run_.loaded.body_loads[i],
                         std::move(before.responses), options_.n_threads, clock_);
      after.responses_reused = before.responses_reused;
      after.search = std::move(before.search);
      after.vibration = std::move(before.vibration);
      set_errors(after, errors);
      bound_dropped_effects(run_.scene, i, run_.loaded, after);
    }
  }

  SceneRunOptions options_;
  StageClock& clock_;
  Clock::time_point start_;
  SceneRun run_;
  std::vector<BodyFiles> files_;
  std::vector<std::string> warnings_;
};

}  // namespace

SceneRun::SceneRun() = default;
SceneRun::SceneRun(const SceneRun&) = default;
SceneRun::SceneRun(SceneRun&&) noexcept = default;
SceneRun& SceneRun::operator=(const SceneRun&) = default;
SceneRun& SceneRun::operator=(SceneRun&&) noexcept = default;
SceneRun::~SceneRun() = default;

bool SceneRun::met() const {
  return std::all_of(analyses.begin(), analyses.end(), [](const auto& a) { return a.search.met; });
}

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
