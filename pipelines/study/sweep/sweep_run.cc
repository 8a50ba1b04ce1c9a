#include "pipelines/study/sweep/sweep_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <set>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/parallel.h"
#include "pipelines/loads/stage/same_body.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/scene/reader/scene_tree.h"
#include "pipelines/study/sweep/swept_bodies.h"
#include "pipelines/study/sweep/whole_run.h"
#include "pipelines/study/variations/point_work.h"

namespace pipelines {
namespace {

/// Rows that are handed on together: seconds of work on one core.
constexpr std::size_t points_of_loads_at_once = 2000, most_points_of_bodies_at_once = 64;

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

std::vector<std::string> names_of(const std::vector<SweepPoint>& points) {
  std::vector<std::string> names;
  for (const auto& point : points) {
    std::string name;
    for (const auto& setting : point.settings) name += (name.empty() ? "" : ", ") + setting;
    names.push_back(name.empty() ? "the scene" : name);
  }
  return names;
}

std::string names_of_bodies(const Scene& scene) {
  std::string names;
  for (const auto& body : scene.bodies) names += (names.empty() ? "" : ", ") + body.name;
  return names.empty() ? "no body" : names;
}

/// What a point has beside numbers, which name no file.
std::string texts_of(const SweepPoint& point) {
  std::string texts;
  for (std::size_t v = 0; v < point.values.size(); ++v)
    if (std::isnan(point.numbers[v])) texts += point.values[v] + '\n';
  return texts;
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
  Implementation(SweepOptions options, const std::vector<SweepPoint>& points)
      : options_(std::move(options)),
        bodies_(
            options_, [this](std::size_t p) { return read(p); }, names_of(points)) {
    name_effects(points);
    for (const auto& point : points) settings_.push_back(point.settings);
    names_.resize(std::size_t(n_threads()));
    refused_.resize(settings_.size());
    std::exception_ptr first_failure;
    std::string first_bodies;
    std::size_t n_read = 0;
    std::set<std::string> texts;
    for (std::size_t p = 0; p < settings_.size(); ++p) {
      const bool names_other_files = texts.insert(texts_of(points[p])).second;
      if (n_read > 0 && !needs_bodies_ && options_.loads_only && !names_other_files)
        continue;  // it is read when it is run
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
      const auto bodies = names_of_bodies(scene);
      if (n_read > 0 && bodies != first_bodies) {
        refused_[p] =
            fmt::format("has {} where the points before have {}; sweep points of other bodies apart", bodies,
                        first_bodies);
        continue;
      }
      first_bodies = bodies;
      if (n_read++ == 0)
        needs_bodies_ = !scene.bodies.empty() && (!options_.loads_only || !scene.masses_from_mesh.empty());
      if (accepted_.empty()) accepted_ = scene.bodies;
      if (needs_bodies_) bodies_.sort_in(p, scene);
    }
    if (n_read == 0) std::rethrow_exception(first_failure);
  }

  bool has_chosen_effects() const { return has_chosen_effects_; }
  std::size_t n_improved_meshes() const { return bodies_.n_improved_meshes(); }
  const std::vector<std::string>& cache_faults() const { return bodies_.cache_faults(); }

  SweepForecast forecast() const {
    SweepForecast result;
    result.n_points = std::size_t(std::count(refused_.begin(), refused_.end(), std::string()));
    if (!options_.loads_only && !options_.whole_runs) result.bodies = bodies_.forecast();
    return result;
  }

  std::vector<std::size_t> groups(int n_shares) const {
    std::vector<std::size_t> result;
    std::map<std::vector<std::size_t>, std::size_t> known;  // by meshes
    for (std::size_t p = 0; p < settings_.size(); ++p)
      result.push_back(needs_bodies_ ? known.emplace(bodies_.meshes(p), known.size()).first->second
                                     : p * std::size_t(n_shares) / settings_.size());
    return result;
  }

  void keep_points(const std::vector<char>& is_own) {
    is_own_ = is_own;
    for (std::size_t p = 0; p < is_own.size(); ++p)
      if (is_own[p] == 0) bodies_.leave_out(p);
  }

  std::vector<SweepRow> run(StageClock& clock, std::vector<std::optional<SweepRow>> known,
                            const SweepListener& listener) {
    known.resize(settings_.size());
    std::vector<SweepRow> rows(settings_.size());
    std::vector<std::size_t> open;
    for (std::size_t p = 0; p < rows.size(); ++p) {
      if (known[p])
        rows[p] = std::move(*known[p]);
      else if (is_own_.empty() || is_own_[p] != 0)
        open.push_back(p);
    }
    const bool with_bodies = needs_bodies_ && !options_.loads_only;
    const std::size_t at_once = with_bodies ? points_of_bodies_at_once() : points_of_loads_at_once;
    for (std::size_t begin = 0; begin < open.size(); begin += at_once) {
      const std::size_t end = std::min(open.size(), begin + at_once);
      std::vector<std::size_t> points(open.begin() + std::ptrdiff_t(begin),
                                      open.begin() + std::ptrdiff_t(end));
      if (with_bodies) {
        for (const auto p : points) rows[p].refused = refused_[p];
        if (options_.whole_runs)
          run_whole(points, rows, clock);
        else
          bodies_.run(points, rows, clock);
      } else {
        clock.run("points", [&] {
          if (needs_bodies_) mesh_for_masses(points);
          for_each_parallel(points.size(), n_threads(), [&](std::size_t worker, std::size_t i) {
            rows[points[i]] = loads_row(points[i], names_[worker]);
          });
          std::fill(names_.begin(), names_.end(), names_.front());
        });
      }
      clock.advance(double(end) / double(open.size()), fmt::format("{} of {} points", end, open.size()));
      listener(points, rows);
    }
    const auto& accuracy = options_.accuracy;
    if (with_bodies && !options_.whole_runs && accuracy.tolerance > 0 && !accuracy.by_default) {
      const auto improved = bodies_.improve(rows, accuracy.tolerance, clock);
      if (!improved.empty()) listener(improved, rows);
    }
    return rows;
  }

private:
  int n_threads() const { return threads(options_.n_threads); }

  /// Points whose bodies are solved together: as many as a solution serves, so that no solution's points are
  /// lost with the next one.
  std::size_t points_of_bodies_at_once() const {
    if (options_.whole_runs) return 1;
    std::size_t n_solutions = 1;
    for (const auto& body : bodies_.forecast()) n_solutions = std::max(n_solutions, body.n_solutions);
    return std::clamp(settings_.size() / n_solutions, std::size_t(1), most_points_of_bodies_at_once);
  }

  Scene read(std::size_t p, bool loads_follow = false) const {
    auto settings = options_.settings;
    settings.insert(settings.end(), settings_[p].begin(), settings_[p].end());
    const auto has_accepted_shape = [this](const BodyScene& body) {
      return std::any_of(accepted_.begin(), accepted_.end(),
                         [&](const BodyScene& other) { return have_one_mesh(other, body); });
    };
    return read_scene(options_.scene, options_.tree, settings,
                      {has_accepted_shape, !options_.loads_only, loads_follow});
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

  void run_whole(const std::vector<std::size_t>& points, std::vector<SweepRow>& rows,
                 StageClock& clock) const {
    for (const auto p : points)
      if (auto& refused = rows[p].refused; refused.empty())
        refused = point_refusal([&] { rows[p] = whole_run(read(p), options_, clock); });
  }

  void mesh_for_masses(const std::vector<std::size_t>& points) {
    for (const auto p : points) {
      if (!refused_[p].empty()) continue;
      auto& mesh = meshes_[bodies_.combination(p)];
      auto& refused = refused_bodies_[bodies_.combination(p)];
      if (mesh || !refused.empty()) continue;
      refused = point_refusal(
          [&] { mesh = std::make_shared<const std::vector<MeshedBody>>(mesh_bodies(read(p))); });
    }
  }

  /// @param names  names of the rows before, to share
  SweepRow loads_row(std::size_t p, SweepFigures& names) const {
    SweepRow row;
    row.refused = refused_[p];
    if (row.refused.empty() && needs_bodies_) row.refused = refused_bodies_.at(bodies_.combination(p));
    if (!row.refused.empty()) return row;
    // First without the reader's rehearsal of the load stage, which follows at once: what refuses a point is
    // found by either, but the reader says where in the scene it stands.
    for (const bool loads_follow : {true, false}) {
      if (loads_follow && needs_bodies_) continue;
      row.figures = SweepFigures::like(names);
      row.refused = point_refusal([&] { add_loads(row, p, loads_follow); });
      if (row.refused.empty()) break;
    }
    if (row.refused.empty())
      names = SweepFigures::like(row.figures);
    else
      row.figures = {};
    return row;
  }

  void add_loads(SweepRow& row, std::size_t p, bool loads_follow) const {
    Scene scene = read(p, loads_follow);
    std::vector<BearingScene> bearings;  // bearings at a port of a body need the body
    if (needs_bodies_) scene.machine = agree_masses(scene, *meshes_.at(bodies_.combination(p))).machine;
    auto loads = load_stage(scene, scene.machine);
    for (const auto& bearing : scene.bearings)
      if (scene.bodies.empty() || force_of(bearing.load, loads, {}))
        bearings.push_back(bearing);
      else if (loads_follow)
        throw StageRefused("the bearing \"" + bearing.name + "\" has a load that the rehearsal would know");
    const auto lives = bearing_lives(bearings, loads, {});
    warn_beyond_ratings(bearings, lives, loads);
    add_load_figures(row, scene, loads, lives);
  }

  SweepOptions options_;
  std::vector<std::vector<std::string>> settings_;  ///< by point
  std::vector<std::string> refused_;                ///< by point: why it cannot be read
  std::vector<char> is_own_;                        ///< by point; empty: all are
  SweptBodies bodies_;
  std::vector<BodyScene> accepted_;  ///< bodies of the first point that can be read
  // Meshes and refusals by what a point's bodies share, SweptBodies::combination.
  std::map<std::vector<std::size_t>, std::shared_ptr<const std::vector<MeshedBody>>> meshes_;  ///< for masses
  std::map<std::vector<std::size_t>, std::string> refused_bodies_;  ///< why; empty: not
  std::vector<SweepFigures> names_;  ///< names of figures, by thread: empty rows
  bool needs_bodies_ = true, has_chosen_effects_ = false;
};

SweepRun::SweepRun(SweepOptions options, const std::vector<SweepPoint>& points)
    : implementation_(std::make_unique<Implementation>(std::move(options), points)) {}

SweepRun::~SweepRun() = default;

SweepForecast SweepRun::forecast() const {
  return implementation_->forecast();
}

std::size_t SweepRun::n_improved_meshes() const {
  return implementation_->n_improved_meshes();
}

const std::vector<std::string>& SweepRun::cache_faults() const {
  return implementation_->cache_faults();
}

bool SweepRun::has_chosen_effects() const {
  return implementation_->has_chosen_effects();
}

std::vector<std::size_t> SweepRun::groups(int n_shares) const {
  return implementation_->groups(n_shares);
}

void SweepRun::keep_points(const std::vector<char>& is_own) {
  implementation_->keep_points(is_own);
}

std::vector<SweepRow> SweepRun::run(StageClock& clock, std::vector<std::optional<SweepRow>> known,
                                    const SweepListener& listener) {
  return implementation_->run(clock, std::move(known), listener);
}

}  // namespace pipelines
