#include "pipelines/accuracy.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "fem/beam_responses.h"
#include "pipelines/cheap_rungs.h"
#include "pipelines/effect_choice.h"
#include "pipelines/effect_report.h"
#include "pipelines/fineness.h"
#include "pipelines/refinement.h"
#include "pipelines/scene_run.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double even_factors[] = {0.5, 0.75, 1, 1.5, 2, 3};
/// Cells become half as large from one size of harmonics to the next. Ends of loaded zones let stress
/// converge with first order only: of a change d, d is missing still, and 2 d on the coarser mesh. As
/// learn_from_change takes it:
constexpr double finer_of_two = 1.4142135623730951,
                 first_of_two = 1.224744871391589;  // squares less 1: 1 and 1/2
constexpr double usual_tolerance = 0.05;
constexpr double overkill = 0.1;               // of the tolerance: no finer run is made
constexpr double growth_of_seconds = 1.6;      // of a run, with the number of unknowns
constexpr double share_for_even_meshes = 0.5;  // of the time; the rest is for refined ones

/// Of the beam's own estimate: it knows nothing of loads beside a fillet, nor of short segments.
constexpr double beam_safety = 3;

/// A cheap model's responses, and what the model itself is known to be off by.
struct CheapRung {
  fem::UnitResponses responses;
  double model_error = 0;  ///< relative
  std::string method;
};

std::optional<CheapRung> beam_rung(const BodyScene& body, const meshes::BodyMesh& mesh,
                                   const std::vector<fem::UnitLoad>& loads) {
  auto responses = beam_responses(body, mesh, loads);
  if (!responses) return std::nullopt;
  return CheapRung{std::move(*responses), beam_safety * fem::beam_model_error(*beam_shaft(body, mesh)),
                   "beam: spread of the fillets' published factors and eccentric shoulders, times 3"};
}

std::optional<CheapRung> axisymmetric_rung(const BodyScene& body, const meshes::BodyMesh& mesh,
                                           const std::vector<fem::UnitLoad>& loads) {
  auto rung = axisymmetric_responses(body, mesh, loads);
  if (!rung) return std::nullopt;
  return CheapRung{std::move(rung->responses), rung->model_error,
                   "axisymmetric: eccentric shoulders taken as concentric"};
}

double total_seconds(const std::vector<StageCost>& stages) {
  double sum = 0;
  for (const auto& stage : stages) sum += stage.seconds;
  return sum;
}

class Ladder {
public:
  Ladder(const Scene& scene, std::size_t body, const AccuracyOptions& options, StageClock& clock)
      : scene_(scene), body_(body), options_(options), clock_(clock), start_(Clock::now()) {
    fs::create_directories(scratch());
    for (const auto& one : scene_.bodies)
      others_.push_back(clock_.run(
          "meshes", [&] { return mesh_body(one, scratch() / (one.name + ".msh"), springs_of(scene_)); }));
    scene_ = with_effects_chosen(scene_, others_, negligible_share(tolerance()));
  }
  ~Ladder() {
    std::error_code ignored;
    fs::remove_all(scratch(), ignored);
  }
  Ladder(const Ladder&) = delete;
  Ladder& operator=(const Ladder&) = delete;

  AccuracyStudy climb() {
    cheap_rungs();
    even_meshes();
    refined_meshes();
    return compare();
  }

private:
  fs::path scratch() const { return options_.directory / "rungs"; }
  double tolerance() const { return options_.tolerance > 0 ? options_.tolerance : scene_tolerance(); }
  double scene_tolerance() const {
    return scene_.wish.tolerance > 0 ? scene_.wish.tolerance : usual_tolerance;
  }
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// Shown as one stage of the study; the run's own stages go into its row.
  template <typename Work>
  auto timed(const std::string& name, Work&& work) {
    return clock_.run(name, [&] {
      forget_peak_memory();
      return work();
    });
  }

  void cheap_rungs() {
    if (governing_has_hot_spots()) return;
    StageClock silent;
    const auto loaded = load_bodies(scene_, others_, silent);
    const auto& loads = loaded.body_loads[body_];
    cheap_rung("beam", scene_.bodies[body_], loaded,
               [&](const BodyScene& body) { return beam_rung(body, others_[body_].mesh, loads.unit_loads); });
    // Each size learns from the one before; the first from the second.
    std::vector<std::size_t> sizes;
    for (const double factor : {0.5, 1.0, 2.0}) {
      const auto body = with_fineness(scene_.bodies[body_], factor);
      if (cheap_rung("axisymmetric", body, loaded, [&](const BodyScene& finer) {
            return axisymmetric_rung(finer, others_[body_].mesh, loads.unit_loads);
          }))
        sizes.push_back(rows_.size() - 1);
    }
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      auto& row = rows_[sizes[i]];
      const double other_Pa =
          rows_[sizes[i > 0 ? i - 1 : std::min<std::size_t>(1, sizes.size() - 1)]].value_Pa;
      row.errors.set_numerical({"discretisation", "", 0});
      learn_from_change(row.errors, row.value_Pa - other_Pa, i > 0 ? finer_of_two : first_of_two);
      if (i > 0) row.seconds += rows_[sizes[i - 1]].seconds;
    }
  }

  /// @param solve  gives responses, if the body has this rung
  /// @return whether it has
  template <typename Solve>
  bool cheap_rung(const std::string& name, const BodyScene& body, const LoadedScene& loaded, Solve&& solve) {
    std::optional<AccuracyRow> row;
    std::vector<double> seconds;
    timed(name, [&] {
      for (int repeat = 0; repeat < options_.n_repeats; ++repeat) {
        StageClock own;
        auto rung = own.run("solve", [&] { return solve(body); });
        if (!rung) return;
        row = cheap_row(name, body, loaded, std::move(*rung), own);
        seconds.push_back(row->seconds);
      }
    });
    if (!row) return false;
    add(std::move(*row), seconds);
    return true;
  }

  AccuracyRow cheap_row(const std::string& name, const BodyScene& body, const LoadedScene& loaded,
                        CheapRung rung, StageClock& own) {
    const auto& loads = loaded.body_loads[body_];
    const auto& mesh = others_[body_].mesh;
    const auto maximum = own.run("superpose", [&] {
      return envelope(loads.history, rung.responses, std::max(1, options_.n_threads));
    });
    const auto places = locate_nodes(rung.responses.nodes, mesh.features, mesh.ports, mesh.sharp_edges);
    const auto node = peak_node(maximum.von_mises.value_Pa, places);
    AccuracyRow row;
    row.rung = name;
    row.fineness = name == "beam" ? "published fillet factors" : fineness_text(body);
    row.instants_per_turn = scene_.sampling.instants_per_turn;
    row.n_dofs = rung.responses.n_dofs;
    row.value_Pa = maximum.von_mises.value_Pa[node];
    row.principal_Pa = maximum.principal.value_Pa[peak_node(maximum.principal.value_Pa, places)];
    row.errors = self_estimate({{{node, 1.0}}, maximum.von_mises.instant[node]}, rung.responses, loads,
                               scene_.bodies[body_].material, 0);
    row.errors.model.push_back({"model", rung.method, rung.model_error * row.value_Pa});
    finish(row, own);
    return row;
  }

  bool governing_has_hot_spots() const { return !others_[body_].mesh.hot_spots.empty(); }

  void finish(AccuracyRow& row, const StageClock& own) const {
    row.stages = own.costs();
    row.seconds = total_seconds(row.stages);
    row.gigabytes = peak_memory_gigabytes();
  }

  void add(AccuracyRow row, const std::vector<double>& seconds) {
    if (!seconds.empty()) {
      const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
      row.spread_s = *most - *least;
      row.seconds = 0;
      for (const double s : seconds) row.seconds += s / double(seconds.size());
    }
    rows_.push_back(std::move(row));
  }

  SceneRunOptions run_options() const {
    SceneRunOptions options;
    options.directory = scratch();
    options.n_threads = options_.n_threads;
    options.fresh = true;
    options.keep = false;
    options.only = body_;
    options.others = others_;
    return options;
  }

  static AccuracyRow row_of(const std::string& rung, const SceneRun& run) {
    const auto& analysis = run.analyses.front();
    const auto stress = governing_stress(analysis);
    AccuracyRow row;
    row.rung = rung;
    row.fineness = fineness_text(analysis.scene);
    row.instants_per_turn = run.scene.sampling.instants_per_turn;
    row.n_dofs = analysis.responses.n_dofs;
    row.value_Pa = stress.value_Pa;
    row.principal_Pa = analysis.envelope.principal.value_Pa[analysis.principal_node];
    row.errors = stress.errors;
    return row;
  }

  void even_meshes() {
    if (!can_be_refined(scene_.bodies[body_])) return even_mesh(1);
    double last_seconds = 0, last_dofs = 0;
    for (const double factor : even_factors) {
      const double dofs = double(others_[body_].model->n_dofs()) * factor * factor * factor;
      const double predicted =
          last_dofs > 0 ? last_seconds * std::pow(dofs / last_dofs, growth_of_seconds) : 0;
      if (elapsed() + predicted > share_for_even_meshes * options_.time_limit_s) return;
      even_mesh(factor);
      const auto& row = rows_.back();
      if (factor >= 1 && row.errors.numerical_Pa() <= overkill * tolerance() * row.value_Pa) return;
      last_seconds = rows_.back().rung == "even mesh" ? rows_.back().seconds : last_seconds;
      last_dofs = dofs;
    }
  }

  void even_mesh(double factor) {
    Scene scene = scene_;
    scene.bodies[body_] = with_fineness(scene.bodies[body_], factor);
    std::vector<double> seconds;
    AccuracyRow row;
    std::optional<SceneRun> last;
    try {
      timed(fmt::format("even mesh, cells 1/{:g}", factor), [&] {
        do {
          StageClock own;
          last = run_scene(scene, run_options(), own);
          row = row_of("even mesh", *last);
          finish(row, own);
          seconds.push_back(row.seconds);
        } while (int(seconds.size()) < options_.n_repeats && row.seconds < 0.1 * options_.time_limit_s);
      });
    } catch (const std::runtime_error&) {
      return;  // too coarse for the mesher's demands on quality, or too large for the memory
    }
    if (even_before_ && even_before_->n_dofs == row.n_dofs)
      return;  // too little finer for whole numbers of cells
    const AccuracyRow plain = row;
    if (even_before_)
      learn_from_change(row.errors, row.value_Pa - even_before_->value_Pa,
                        std::cbrt(double(row.n_dofs) / double(even_before_->n_dofs)));
    even_before_ = plain;
    add(row, seconds);
    if (factor != 1) return;
    prices_ = price_effects(last->analyses.front(), seconds_of(row.stages, "solve"),
                            seconds_of(row.stages, "superpose"), evaluation_seconds());
    fewer_instants(scene, row, std::move(*last));
  }

  /// Seconds of the load stage that each effect is worth.
  std::vector<std::pair<std::string, double>> evaluation_seconds() const {
    std::vector<std::pair<std::string, double>> seconds;
    const double n_instants = double(scene_.sampling.turns) * scene_.sampling.instants_per_turn;
    for (const auto& worth : report_effects(scene_, 0.01).effects)
      seconds.push_back({worth.effect.name, worth.seconds_per_instant * n_instants});
    return seconds;
  }

  /// The same responses at fewer instants: only loads and superposition are done anew.
  void fewer_instants(Scene scene, const AccuracyRow& full, SceneRun run) {
    for (const int divisor : {2, 4, 8}) {
      scene.sampling.instants_per_turn = scene_.sampling.instants_per_turn / divisor;
      if (scene.sampling.instants_per_turn < 8) return;
      StageClock own;
      run.loaded = load_bodies(scene, std::move(run.loaded.meshed), own);
      auto& analysis = run.analyses.front();
      analysis =
          superpose_body(scene, scene.bodies[body_], run.loaded.meshed[body_], run.loaded.body_loads[body_],
                         std::move(analysis.responses), options_.n_threads, own);
      run.scene = scene;
      auto row = row_of("fewer instants", run);
      row.errors.set_numerical({"discretisation", "as at all instants", full.errors.of("discretisation")});
      finish(row, own);
      for (const auto& stage : full.stages)
        if (stage.stage == "mesh" || stage.stage == "solve" || stage.stage == "write")
          row.stages.push_back(stage);
      row.seconds = total_seconds(row.stages);
      row.gigabytes = full.gigabytes;
      add(std::move(row), {});
    }
  }

  void refined_meshes() {
    if (!can_be_refined(scene_.bodies[body_])) return;
    auto options = run_options();
    options.wish.tolerance = overkill * tolerance();
    options.wish.time_limit_s = options_.time_limit_s - elapsed();
    if (options.wish.time_limit_s <= 0) return;
    StageClock own;
    const auto run = timed("refined meshes", [&] { return run_scene(scene_, options, own); });
    AccuracyRow row = row_of("refined mesh", run);
    const double gigabytes = peak_memory_gigabytes();
    double seconds = 0;
    for (const auto& step : run.analyses.front().search.steps) {
      row.fineness = step.fineness;
      row.instants_per_turn = step.instants_per_turn;
      row.n_dofs = step.n_dofs;
      row.value_Pa = step.value_Pa;
      row.errors = step.errors;
      row.principal_Pa = step.principal_Pa;
      seconds += step.seconds;
      row.seconds = seconds;
      row.stages = {{"all steps so far", seconds, gigabytes}};
      row.gigabytes = gigabytes;
      rows_.push_back(row);
    }
  }

  AccuracyStudy compare() {
    AccuracyStudy study;
    study.body = scene_.bodies[body_].name;
    study.quantity = governing_has_hot_spots() ? "hot-spot stress" : "peak von Mises stress";
    study.tolerance = tolerance();
    study.rows = std::move(rows_);
    study.effects = std::move(prices_);
    compare_runs(study, options_.reference_Pa);
    return study;
  }

  Scene scene_;
  std::size_t body_;
  AccuracyOptions options_;
  StageClock& clock_;
  Clock::time_point start_;
  std::vector<MeshedBody> others_;  ///< all bodies at the scene's own fineness
  std::vector<AccuracyRow> rows_;
  std::optional<AccuracyRow> even_before_;  ///< the last even mesh
  std::vector<EffectPrice> prices_;
};

}  // namespace

AccuracyStudy study_accuracy(const Scene& scene, std::size_t body, const AccuracyOptions& options,
                             StageClock& clock) {
  return Ladder(scene, body, options, clock).climb();
}

}  // namespace pipelines
