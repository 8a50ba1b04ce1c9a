#include "pipelines/sweep/sweep_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

#include "pipelines/analysis/respond.h"
#include "pipelines/common/errors.h"
#include "pipelines/common/failure.h"
#include "pipelines/scene/scene_tree.h"
#include "pipelines/sweep/body_design.h"
#include "pipelines/sweep/same_body.h"

namespace pipelines {
namespace {

/// Rows that are handed on together: seconds of work on one core.
constexpr std::size_t points_of_loads_at_once = 2000, points_of_bodies_at_once = 64;

/// What a point's own numbers may be refused for becomes its row; a disk that is full and errors of the
/// program end the sweep.
template <typename Work>
std::string point_refusal(const Work& work) {
  try {
    work();
    return {};
  } catch (const FileError&) {
    throw;
  } catch (const std::filesystem::filesystem_error&) {
    throw;
  } catch (...) {
    auto failure = failure_in_flight();
    if (failure.message.find("internal error") != std::string::npos) throw;
    return std::move(failure.message);
  }
}

/// Calls work(worker, i) for all i below n on several threads.
template <typename Work>
void for_each_parallel(std::size_t n, int n_threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto run = [&](std::size_t worker) {
    try {
      for (std::size_t i = next++; i < n; i = next++) work(worker, i);
    } catch (...) {
      const std::lock_guard lock(failing);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < n_threads; ++t) threads.emplace_back(run, std::size_t(t));
  for (auto& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

/// The key of a setting, "KEY=VALUE".
std::string key_of(const std::string& setting) {
  const auto key = setting.substr(0, setting.find('='));
  return key.substr(0, key.find_last_not_of(' ') + 1);
}

bool sets_effects(const std::string& setting) {
  return key_of(setting) == "effects";
}

bool switches_effect(const std::string& setting) {
  return key_of(setting).rfind("effects.", 0) == 0;
}

/// effects = [...] as the scene has them on.
std::string effects_setting(const Scene& scene) {
  std::string list;
  for (const auto& effect : scene.effects) list += (list.empty() ? "\"" : ", \"") + effect + '"';
  return "effects=[" + list + "]";
}

}  // namespace

class SweepRun::Implementation {
public:
  Implementation(SweepOptions options, const std::vector<SweepPoint>& points) : options_(std::move(options)) {
    name_effects(points);
    for (const auto& point : points) settings_.push_back(point.settings);
    of_point_.resize(settings_.size());
    refused_.resize(settings_.size());
    std::exception_ptr first_failure;
    std::size_t n_read = 0;
    for (std::size_t p = 0; p < settings_.size(); ++p) {
      if (p > 0 && n_read > 0 && !needs_bodies_) break;  // the rest is read when it is run
      Scene scene;
      refused_[p] = point_refusal([&] {
        try {
          scene = read(p);
        } catch (...) {
          if (!first_failure) first_failure = std::current_exception();
          throw;
        }
      });
      if (!refused_[p].empty()) continue;
      if (n_read++ == 0) {
        needs_bodies_ = !scene.bodies.empty() && (!options_.loads_only || !scene.masses_from_mesh.empty());
        for (const auto& body : scene.bodies) bodies_.push_back({body.name, {}, {}});
      }
      if (needs_bodies_) sort_in(p, scene);
    }
    if (n_read == 0) std::rethrow_exception(first_failure);
  }

  bool has_chosen_effects() const { return has_chosen_effects_; }

  SweepForecast forecast() const {
    SweepForecast result;
    result.n_points = std::size_t(std::count(refused_.begin(), refused_.end(), std::string()));
    if (!options_.loads_only)
      for (const auto& body : bodies_)
        result.bodies.push_back({body.name, body.shapes.size(), body.solutions.size()});
    return result;
  }

  std::vector<SweepRow> run(StageClock& clock, std::vector<std::optional<SweepRow>> known,
                            const SweepListener& listener) {
    known.resize(settings_.size());
    std::vector<SweepRow> rows(settings_.size());
    std::vector<std::size_t> open;
    for (std::size_t p = 0; p < rows.size(); ++p) {
      if (known[p])
        rows[p] = std::move(*known[p]);
      else
        open.push_back(p);
    }
    const bool with_bodies = needs_bodies_ && !options_.loads_only;
    const std::size_t at_once = with_bodies ? points_of_bodies_at_once : points_of_loads_at_once;
    for (std::size_t begin = 0; begin < open.size(); begin += at_once) {
      const std::size_t end = std::min(open.size(), begin + at_once);
      std::vector<std::size_t> points(open.begin() + std::ptrdiff_t(begin),
                                      open.begin() + std::ptrdiff_t(end));
      if (with_bodies)
        run_points(points, rows, clock);
      else
        clock.run("points", [&] {
          if (needs_bodies_) mesh_for_masses(points);
          for_each_parallel(points.size(), n_threads(),
                            [&](std::size_t, std::size_t i) { rows[points[i]] = loads_row(points[i]); });
        });
      clock.advance(double(end) / double(open.size()), fmt::format("{} of {} points", end, open.size()));
      listener(points, rows);
    }
    return rows;
  }

private:
  struct Solution {
    std::size_t shape;
    Scene scene;                                             ///< as read, of its first point
    std::vector<std::shared_ptr<const BodyDesign>> designs;  ///< several where effects bring other loads
  };
  struct SweptBody {
    std::string name;
    std::vector<BodyScene> shapes;  ///< as read
    std::vector<Solution> solutions;
  };

  int n_threads() const { return threads(options_.n_threads); }

  Scene read(std::size_t p) const {
    auto settings = options_.settings;
    settings.insert(settings.end(), settings_[p].begin(), settings_[p].end());
    return read_scene(options_.scene, options_.tree, settings);
  }

  /// Single effects can be switched in a list only, and what the program would choose may change from point
  /// to point.
  void name_effects(const std::vector<SweepPoint>& points) {
    bool single = false;
    for (const auto& point : points)
      for (const auto& setting : point.settings) {
        if (sets_effects(setting)) return;
        single = single || switches_effect(setting);
      }
    const Scene scene = read_scene(options_.scene, options_.tree, options_.settings);
    has_chosen_effects_ = scene.effect_choice.open;
    if (!has_chosen_effects_ && !single) return;
    auto& settings = options_.settings;
    settings.erase(std::remove_if(settings.begin(), settings.end(),
                                  [](const auto& s) { return sets_effects(s) || switches_effect(s); }),
                   settings.end());
    settings.push_back(effects_setting(scene));
  }

  /// Finds out which points share meshes and solutions.
  void sort_in(std::size_t p, const Scene& scene) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      auto& body = bodies_[b];
      const auto shape = std::find_if(body.shapes.begin(), body.shapes.end(), [&](const BodyScene& other) {
        return have_one_mesh(other, scene.bodies[b]);
      });
      const auto i_shape = std::size_t(shape - body.shapes.begin());
      if (shape == body.shapes.end()) body.shapes.push_back(scene.bodies[b]);
      const auto solution =
          std::find_if(body.solutions.begin(), body.solutions.end(), [&](const Solution& other) {
            return other.shape == i_shape && have_one_stiffness(other.scene, scene, b);
          });
      of_point_[p].push_back(std::size_t(solution - body.solutions.begin()));
      if (solution == body.solutions.end()) body.solutions.push_back({i_shape, scene, {}});
    }
  }

  // ---- The load stage alone ----

  void mesh_for_masses(const std::vector<std::size_t>& points) {
    for (const auto p : points) {
      if (!refused_[p].empty()) continue;
      auto& mesh = meshes_[of_point_[p]];
      auto& refused = refused_bodies_[of_point_[p]];
      if (mesh || !refused.empty()) continue;
      refused = point_refusal([&] { mesh = std::make_shared<const ScratchMeshes>(read(p)); });
    }
  }

  SweepRow loads_row(std::size_t p) const {
    SweepRow row;
    row.refused = refused_[p];
    if (row.refused.empty() && needs_bodies_) row.refused = refused_bodies_.at(of_point_[p]);
    if (!row.refused.empty()) return row;
    row.refused = point_refusal([&] {
      Scene scene = read(p);
      std::vector<BearingScene> bearings;  // those at a port of a body need the body
      if (needs_bodies_) scene.machine = agree_masses(scene, meshes_.at(of_point_[p])->bodies()).machine;
      const auto loads = load_stage(scene, scene.machine);
      for (const auto& bearing : scene.bearings)
        if (scene.bodies.empty() || force_of(bearing.load, loads, {})) bearings.push_back(bearing);
      add_load_figures(row, scene, loads, bearing_lives(bearings, loads, {}));
    });
    return row;
  }

  // ---- Bodies ----

  /// Points whose bodies are solved run at the same time; the others wait for a design.
  void run_points(const std::vector<std::size_t>& points, std::vector<SweepRow>& rows, StageClock& clock) {
    std::vector<std::size_t> wait;
    for (const auto p : points) {
      rows[p].refused = refused_[p];
      if (!refused_[p].empty()) continue;
      rows[p].refused = design_bodies(p, clock);
      if (!rows[p].refused.empty()) continue;
      wait.push_back(p);
    }
    std::vector<char> is_uncovered(wait.size(), 0);
    std::vector<Scratch> scratch{std::size_t(n_threads())};
    clock.run("points", [&] {
      for_each_parallel(wait.size(), n_threads(), [&](std::size_t worker, std::size_t i) {
        is_uncovered[i] = !body_row(wait[i], rows[wait[i]], scratch[worker]);
      });
    });
    for (std::size_t i = 0; i < wait.size(); ++i) {
      if (!is_uncovered[i]) continue;
      auto& row = rows[wait[i]];
      row = {};
      row.refused = point_refusal([&] { solve_for(wait[i], clock); });
      if (row.refused.empty() && !body_row(wait[i], row, scratch.front()))
        row.refused = "its loads do not fit the responses that were solved for it";
    }
  }

  /// Copies of analyses that a thread works on.
  using Scratch = std::map<const BodyDesign*, BodyAnalysis>;

  Solution& solution_of(std::size_t p, std::size_t b) { return bodies_[b].solutions[of_point_[p][b]]; }

  /// Which of a point's bodies is at fault a refusal does not say: it holds for points that combine the same.
  /// @return why not; empty: all bodies of the point have a design
  std::string design_bodies(std::size_t p, StageClock& clock) {
    auto& refused = refused_bodies_[of_point_[p]];
    bool has_all = true;
    for (std::size_t b = 0; b < bodies_.size(); ++b) has_all = has_all && !solution_of(p, b).designs.empty();
    if (refused.empty() && !has_all) refused = point_refusal([&] { solve_for(p, clock); });
    return refused;
  }

  /// The design whose search found a shape's mesh; null if there is none yet.
  const BodyDesign* searched_design(std::size_t b, std::size_t i_shape) const {
    for (const auto& solution : bodies_[b].solutions)
      if (solution.shape == i_shape && !solution.designs.empty()) return solution.designs.front().get();
    return nullptr;
  }

  /// Bodies of a point that no mesh serves are searched; those on a known mesh whose solution or loads are
  /// other ones are solved once on it.
  void solve_for(std::size_t p, StageClock& clock) {
    const Scene as_read = read(p);
    std::vector<const BodyDesign*> on_mesh;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      on_mesh.push_back(searched_design(b, solution_of(p, b).shape));
    const auto n_unknown = std::count(on_mesh.begin(), on_mesh.end(), nullptr);
    if (n_unknown > 1 || n_unknown == std::ptrdiff_t(bodies_.size())) {
      auto run = run_scene(as_read, run_options(next_folder()), clock);
      for (std::size_t b = 0; b < bodies_.size(); ++b)
        if (on_mesh[b] == nullptr) on_mesh[b] = keep_design(p, b, as_read, run, nullptr);
    }
    Scene scene = as_read;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (on_mesh[b] != nullptr) on_mesh[b]->enter(scene, b);
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (on_mesh[b] == nullptr) {
        auto run = run_scene(scene, options_beside(on_mesh, b), clock);
        on_mesh[b] = keep_design(p, b, as_read, run, nullptr);
        on_mesh[b]->enter(scene, b);
      }
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!needs_solution(p, b, on_mesh, scene, clock)) continue;
      auto options = options_beside(on_mesh, b);
      if (on_mesh[b]->serves_other_points()) options.accuracy = {0, 0, true, false};
      auto run = run_scene(scene, options, clock);
      (void)keep_design(p, b, as_read, run, on_mesh[b]);
    }
  }

  /// @param searched  on whose mesh it is; null: on its own
  const BodyDesign* keep_design(std::size_t p, std::size_t b, const Scene& before, SceneRun& run,
                                const BodyDesign* searched) {
    auto design = std::make_shared<BodyDesign>(before.bodies[b], run, b);
    if (searched != nullptr) design->take_shares(*searched);
    solution_of(p, b).designs.push_back(design);
    return design.get();
  }

  std::string next_folder() { return std::to_string(++n_folders_); }

  /// Body b alone is run.
  SceneRunOptions options_beside(const std::vector<const BodyDesign*>& others, std::size_t b) {
    auto options = run_options(next_folder());
    options.only = b;
    for (const auto* other : others) options.others.push_back(other ? other->meshed() : MeshedBody());
    return options;
  }

  SceneRunOptions run_options(const std::string& folder) const {
    SceneRunOptions options;
    options.directory = options_.directory / "bodies" / folder;
    options.n_threads = options_.n_threads;
    options.fresh = options_.fresh;
    options.accuracy = options_.accuracy;
    return options;
  }

  bool needs_solution(std::size_t p, std::size_t b, const std::vector<const BodyDesign*>& on_mesh,
                      const Scene& scene, StageClock& clock) {
    const auto& designs = solution_of(p, b).designs;
    if (designs.empty()) return true;
    if (!designs.front()->serves_other_points()) return false;
    std::vector<MeshedBody> meshed;
    for (const auto* design : on_mesh) meshed.push_back(design->meshed());
    const auto loaded = load_bodies(scene, std::move(meshed), clock);
    return std::none_of(designs.begin(), designs.end(),
                        [&](const auto& design) { return design->covers(loaded.body_loads[b]); });
  }

  /// @return false if a body's responses are not those of the point's loads
  bool body_row(std::size_t p, SweepRow& row, Scratch& scratch) {
    bool covered = true;
    row.refused = point_refusal([&] {
      Scene scene = read(p);
      std::vector<MeshedBody> meshed;
      for (std::size_t b = 0; b < bodies_.size(); ++b) {
        solution_of(p, b).designs.front()->enter(scene, b);
        meshed.push_back(solution_of(p, b).designs.front()->meshed());
      }
      StageClock silent;
      auto loaded = load_bodies(scene, std::move(meshed), silent);
      SweepRow whole;
      add_load_figures(whole, with_masses(scene, loaded), loaded.loads, loaded.bearings);
      for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const auto& designs = solution_of(p, b).designs;
        if (!designs.front()->serves_other_points()) {
          add_cheap(whole, scene, b, loaded, designs.front()->analysis().method);
          continue;
        }
        const auto design = std::find_if(designs.begin(), designs.end(), [&](const auto& candidate) {
          return candidate->covers(loaded.body_loads[b]);
        });
        if (design == designs.end()) {
          covered = false;
          return;
        }
        auto& copy = scratch.try_emplace(design->get(), (*design)->analysis()).first->second;
        try {
          copy = (*design)->at_point(std::move(copy), scene.bodies[b], std::move(loaded.body_loads[b]));
        } catch (...) {
          scratch.erase(design->get());  // what it was moved from is nothing to go on with
          throw;
        }
        add_body_figures(whole, copy, torsion_Pa(scene.bodies[b], copy));
      }
      row = std::move(whole);
    });
    return covered;
  }

  static Scene with_masses(Scene scene, const LoadedScene& loaded) {
    scene.machine = loaded.masses.machine;
    return scene;
  }

  /// Largest torsional stress of a parametric shaft.
  static std::optional<double> torsion_Pa(const BodyScene& body, const BodyAnalysis& analysis) {
    if (body.shaft() == nullptr) return std::nullopt;
    const auto rings = torsion_rings(analysis.loads, analysis.responses, analysis.mesh);
    const auto ring = std::max_element(rings.begin(), rings.end(),
                                       [](const auto& a, const auto& b) { return a.max_Pa < b.max_Pa; });
    return ring == rings.end() ? std::nullopt : std::optional(ring->max_Pa);
  }

  /// A body by its cheap model, which is solved for each point.
  void add_cheap(SweepRow& row, Scene scene, std::size_t b, const LoadedScene& loaded, Method method) {
    const std::lock_guard lock(cheap_);
    auto options = run_options("cheap");
    options.only = b;
    options.keep = false;
    options.others = loaded.meshed;
    scene.method = method;
    StageClock silent;
    const auto run = run_scene(scene, options, silent);
    add_body_figures(row, run.analyses.front(), torsion_Pa(scene.bodies[b], run.analyses.front()));
  }

  SweepOptions options_;
  std::vector<std::vector<std::string>> settings_;  ///< by point
  std::vector<std::string> refused_;                ///< by point: why it cannot be read
  std::vector<std::vector<std::size_t>> of_point_;  ///< by point and body: its solution
  std::vector<SweptBody> bodies_;
  // By what a point combines, of_point_.
  std::map<std::vector<std::size_t>, std::shared_ptr<const ScratchMeshes>> meshes_;  ///< for masses
  std::map<std::vector<std::size_t>, std::string> refused_bodies_;                   ///< why; empty: not
  bool needs_bodies_ = true, has_chosen_effects_ = false;
  int n_folders_ = 0;
  std::mutex cheap_;  ///< cheap models run one at a time: fem's threads are theirs
};

SweepRun::SweepRun(SweepOptions options, const std::vector<SweepPoint>& points)
    : implementation_(std::make_unique<Implementation>(std::move(options), points)) {}

SweepRun::~SweepRun() = default;

SweepForecast SweepRun::forecast() const {
  return implementation_->forecast();
}

bool SweepRun::has_chosen_effects() const {
  return implementation_->has_chosen_effects();
}

std::vector<SweepRow> SweepRun::run(StageClock& clock, std::vector<std::optional<SweepRow>> known,
                                    const SweepListener& listener) {
  return implementation_->run(clock, std::move(known), listener);
}

}  // namespace pipelines
