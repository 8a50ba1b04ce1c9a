#include "pipelines/study/sweep/swept_bodies.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/parallel.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/loads/stage/same_body.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/scene/reader/scene_tree.h"
#include "pipelines/study/variations/point_work.h"

namespace pipelines {
namespace {

Scene with_masses(Scene scene, const Loaded& loaded) {
  scene.machine = loaded.masses.machine;
  return scene;
}

/// Largest torsional stress of a parametric shaft, with its error as a run states it.
/// @param searched  the analysis of a body under other loads whose responses it has
std::optional<LargestTorsion> torsion_of(Judged& analysis, const Judged& searched) {
  if (analysis.scene.shaft() == nullptr) return std::nullopt;
  if (!analysis.diagrams) {
    analysis.diagrams.emplace().rings = torsion_rings(analysis.loads, analysis.responses, analysis.mesh);
    take_torsion_by_harmonics(searched, analysis);
  }
  return largest_torsion(analysis);
}

/// The error of a body's governing stress as a share of it; NaN without.
double error_share(const SweepRow& row, const std::string& body) {
  const std::string figure = "bodies." + body + ".governing";
  return row.figure(figure + ".error") / row.figure(figure);
}

/// The point whose search found a body's mesh; empty of cheap models.
std::string searched_for(const SweepRow& row, const std::string& body) {
  const std::string name = "bodies." + body + ".mesh";
  const auto text =
      std::find_if(row.texts.begin(), row.texts.end(), [&](const auto& t) { return t.first == name; });
  return text == row.texts.end() ? "" : text->second;
}

}  // namespace

SweptBodies::SweptBodies(const SweepOptions& options, ReadPoint read, std::vector<std::string> names)
    : options_(options), read_(std::move(read)), names_(std::move(names)), of_point_(names_.size()) {}

std::vector<SweepForecast::Body> SweptBodies::forecast() const {
  std::vector<SweepForecast::Body> result;
  for (const auto& body : bodies_) result.push_back({body.name, body.shapes.size(), body.solutions.size()});
  return result;
}

void SweptBodies::sort_in(std::size_t p, const Scene& scene) {
  if (bodies_.empty())
    for (const auto& body : scene.bodies) bodies_.push_back({body.name, {}, {}});
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    auto& body = bodies_[b];
    const auto shape = std::find_if(body.shapes.begin(), body.shapes.end(), [&](const Shape& other) {
      return other.method == scene.method && have_one_mesh(other.body, scene.bodies[b]);
    });
    const auto i_shape = std::size_t(shape - body.shapes.begin());
    if (shape == body.shapes.end()) body.shapes.push_back({scene.bodies[b], scene.method});
    const auto solution =
        std::find_if(body.solutions.begin(), body.solutions.end(), [&](const Solution& other) {
          return other.shape == i_shape && have_one_stiffness(other.scene, scene, b);
        });
    of_point_[p].push_back(std::size_t(solution - body.solutions.begin()));
    if (solution == body.solutions.end()) body.solutions.push_back({i_shape, scene, {}});
  }
}

std::vector<std::size_t> SweptBodies::meshes(std::size_t p) const {
  std::vector<std::size_t> result;
  for (std::size_t b = 0; b < of_point_[p].size(); ++b)
    result.push_back(bodies_[b].solutions[of_point_[p][b]].shape);
  return result;
}

void SweptBodies::run(const std::vector<std::size_t>& points, std::vector<SweepRow>& rows,
                      StageClock& clock) {
  std::vector<std::size_t> wait;
  for (const auto p : points) {
    if (!rows[p].refused.empty()) continue;
    rows[p].refused = design_bodies(p, clock);
    if (!rows[p].refused.empty()) continue;
    if (!has_a_solution_of_its_own(p)) {
      wait.push_back(p);
      continue;
    }
    Scratch alone;
    if (!clock.run("points", [&] { return body_row(p, rows[p], alone); }))
      rows[p] = row_once_solved(p, clock);
    forget_solutions_of(p);
  }
  std::vector<char> is_uncovered(wait.size(), 0);
  std::vector<Scratch> scratch{std::size_t(threads(options_.n_threads))};
  clock.run("points", [&] {
    for_each_parallel(wait.size(), int(scratch.size()), [&](std::size_t worker, std::size_t i) {
      is_uncovered[i] = !body_row(wait[i], rows[wait[i]], scratch[worker]);
    });
  });
  for (std::size_t i = 0; i < wait.size(); ++i)
    if (is_uncovered[i]) rows[wait[i]] = row_once_solved(wait[i], clock);
}

SweepRow SweptBodies::row_once_solved(std::size_t p, StageClock& clock) {
  SweepRow row;
  row.refused = point_refusal([&] { solve_for(p, clock); });
  Scratch scratch;
  if (row.refused.empty() && !body_row(p, row, scratch))
    row.refused = "its loads do not fit the responses that were solved for it";
  return row;
}

bool SweptBodies::serves_others(std::size_t p, std::size_t b) const {
  const auto& solutions = bodies_[b].solutions;
  const auto own = of_point_[p][b];
  const auto i_shape = solutions[own].shape;
  const auto& designs = solutions[own].designs;
  const bool has_searched_mesh = designs.empty() || searched_design(b, i_shape) == designs.front().get();
  for (std::size_t q = 0; q < of_point_.size(); ++q) {
    if (q == p || of_point_[q].empty()) continue;
    const auto other = of_point_[q][b];
    if (other == own || (has_searched_mesh && solutions[other].shape == i_shape)) return true;
  }
  return false;
}

bool SweptBodies::has_a_solution_of_its_own(std::size_t p) const {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (!serves_others(p, b)) return true;
  return false;
}

/// Unit responses are hundreds of megabytes: what serves one point alone does not outlive its row.
void SweptBodies::forget_solutions_of(std::size_t p) {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (!serves_others(p, b)) solution_of(p, b).designs.clear();
}

/// Designs the bodies of a point. A refusal does not say which of them is at fault: it holds for points that
/// combine the same.
/// @return why not; empty: all bodies of the point have a design
std::string SweptBodies::design_bodies(std::size_t p, StageClock& clock) {
  auto& refused = refused_[of_point_[p]];
  bool has_all = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) has_all = has_all && !solution_of(p, b).designs.empty();
  if (refused.empty() && !has_all) refused = point_refusal([&] { solve_for(p, clock); });
  return refused;
}

/// The design whose search found a shape's mesh; null if there is none yet.
const BodyDesign* SweptBodies::searched_design(std::size_t b, std::size_t i_shape) const {
  for (const auto& solution : bodies_[b].solutions)
    if (solution.shape == i_shape && !solution.designs.empty()) return solution.designs.front().get();
  return nullptr;
}

/// Bodies of a point that no mesh serves are searched; those on a known mesh whose solution or loads are
/// other ones are solved once on it.
void SweptBodies::solve_for(std::size_t p, StageClock& clock) {
  const Scene as_read = read_(p);
  std::vector<const BodyDesign*> on_mesh;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    on_mesh.push_back(searched_design(b, solution_of(p, b).shape));
  const auto n_unknown = std::count(on_mesh.begin(), on_mesh.end(), nullptr);
  if (n_unknown > 1 || n_unknown == std::ptrdiff_t(bodies_.size())) {
    auto run = run_scene(as_read, run_options(), clock);
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
const BodyDesign* SweptBodies::keep_design(std::size_t p, std::size_t b, const Scene& before, SceneRun& run,
                                           const BodyDesign* searched) {
  for (auto& fault : run.kept.faults) cache_faults_.push_back(std::move(fault));
  auto design = std::make_shared<BodyDesign>(before, run, b, names_[p]);
  if (searched != nullptr) design->take_shares(*searched);
  solution_of(p, b).designs.push_back(design);
  return design.get();
}

/// Body b alone is run.
SceneRunOptions SweptBodies::options_beside(const std::vector<const BodyDesign*>& others, std::size_t b) {
  auto options = run_options();
  options.only = b;
  for (const auto* other : others) options.others.push_back(other ? other->meshed() : MeshedBody());
  return options;
}

SceneRunOptions SweptBodies::run_options() const {
  SceneRunOptions options;
  options.n_threads = options_.n_threads;
  options.fresh = options_.fresh;
  options.accuracy = options_.accuracy;
  options.fatigue = false;
  return options;
}

bool SweptBodies::needs_solution(std::size_t p, std::size_t b, const std::vector<const BodyDesign*>& on_mesh,
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

/// @return false if a body's responses are not those of the point's loads, or are forgotten
bool SweptBodies::body_row(std::size_t p, SweepRow& row, Scratch& scratch) {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (solution_of(p, b).designs.empty()) return false;
  bool covered = true;
  row.refused = point_refusal([&] {
    Scene scene = read_(p);
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
        copy = (*design)->at_point(std::move(copy), scene.bodies[b], std::move(loaded.body_loads[b]),
                                   options_.zones ? &scene.zones : nullptr);
      } catch (...) {
        scratch.erase(design->get());  // what it was moved from is nothing to go on with
        throw;
      }
      add_body_figures(whole, copy, torsion_of(copy, (*design)->analysis()));
      whole.texts.emplace_back("bodies." + scene.bodies[b].name + ".mesh", (*design)->searched_for());
    }
    row = std::move(whole);
  });
  return covered;
}

/// A body by its cheap model, which is solved for each point.
void SweptBodies::add_cheap(SweepRow& row, Scene scene, std::size_t b, const Loaded& loaded, Method method) {
  const std::lock_guard lock(cheap_);
  auto options = run_options();
  options.only = b;
  options.cache = false;
  options.others = loaded.meshed;
  scene.method = method;
  StageClock silent;
  auto run = run_scene(scene, options, silent);
  auto& analysis = run.analyses.front();
  add_body_figures(row, analysis, torsion_of(analysis, analysis));
}

bool SweptBodies::is_met_at_its_own_point(const std::vector<SweepRow>& rows, std::size_t p, std::size_t b,
                                          double tolerance) const {
  const auto& body = bodies_[b].name;
  const auto searched = std::find(names_.begin(), names_.end(), searched_for(rows[p], body));
  return searched != names_.end() &&
         error_share(rows[std::size_t(searched - names_.begin())], body) <= tolerance;
}

std::vector<std::size_t> SweptBodies::improve(std::vector<SweepRow>& rows, double tolerance,
                                              StageClock& clock) {
  std::set<std::size_t> improved;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto& body = bodies_[b].name;
    const auto unmet =
        [&] {  // the worst first; where the search of the mesh itself fell short, so would another
          std::vector<std::size_t> list;
          for (std::size_t p = 0; p < rows.size(); ++p)
            if (rows[p].refused.empty() && error_share(rows[p], body) > tolerance &&
                is_met_at_its_own_point(rows, p, b, tolerance))
              list.push_back(p);
          std::stable_sort(list.begin(), list.end(), [&](std::size_t p, std::size_t q) {
            return error_share(rows[p], body) > error_share(rows[q], body);
          });
          return list;
        };
    std::set<std::size_t> tried;
    for (;;) {
      const auto open = unmet();
      const auto worst =
          std::find_if(open.begin(), open.end(), [&](std::size_t p) { return tried.count(p) == 0; });
      if (worst == open.end()) break;
      tried.insert(*worst);
      const auto before = of_point_[*worst][b];
      auto& swept = bodies_[b];
      swept.shapes.push_back(swept.shapes[swept.solutions[before].shape]);
      swept.solutions.push_back({swept.shapes.size() - 1, read_(*worst), {}});
      const auto own = swept.solutions.size() - 1;
      const auto take = [&](std::size_t p, SweepRow row) {
        const bool is_better = row.refused.empty() && error_share(row, body) < error_share(rows[p], body);
        if (is_better) {
          rows[p] = std::move(row);
          improved.insert(p);
        } else {
          of_point_[p][b] = before;
        }
      };
      clock.advance(double(improved.size()) / double(improved.size() + open.size()),
                    fmt::format("a mesh of {} for point {}, known to {:.2g} % only", body, *worst + 1,
                                100 * error_share(rows[*worst], body)));
      of_point_[*worst][b] = own;
      take(*worst, row_once_solved(*worst, clock));
      if (swept.solutions[own].designs.empty()) continue;
      ++n_improved_;
      for (const auto p : open) {
        if (p == *worst || of_point_[p][b] != before) continue;
        of_point_[p][b] = own;
        SweepRow row;
        Scratch scratch;
        if (!body_row(p, row, scratch)) row.refused = "its loads are others";
        take(p, std::move(row));
      }
    }
  }
  return {improved.begin(), improved.end()};
}

}  // namespace pipelines
