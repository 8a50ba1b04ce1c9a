/// The bodies of a sweep: which points share meshes and unit responses, and their rows.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/variations/body_design.h"
#include "pipelines/study/variations/sweep_options.h"

namespace pipelines {

class SweptBodies {
public:
  using ReadPoint = std::function<Scene(std::size_t point)>;

  /// @param options  outlive this
  /// @param names    names of the points, by their settings
  SweptBodies(const SweepOptions& options, ReadPoint read, std::vector<std::string> names);

  /// Points are sorted in in their order, all of them before any is run.
  void sort_in(std::size_t p, const Scene& scene);
  std::vector<SweepForecast::Body> forecast() const;
  /// Meshes that improve() has searched.
  std::size_t n_improved_meshes() const { return n_improved_; }
  /// Sentences for the user: what is not in the cache, and why.
  const std::vector<std::string>& cache_faults() const { return cache_faults_; }
  /// Number of a point's mesh by body. Empty if the point was not sorted in.
  std::vector<std::size_t> meshes(std::size_t p) const;
  /// Leaves a point as if it had not been sorted in.
  void leave_out(std::size_t p) { of_point_[p].clear(); }
  /// What a point shares: by body the number of its solution. Empty if the point was not sorted in.
  const std::vector<std::size_t>& combination(std::size_t p) const { return of_point_[p]; }

  /// Fills rows[p] of all points. Points whose bodies are solved run at the same time; the others wait for a
  /// design. One with a solution that serves no other point runs as soon as it is there, and
  /// the solution is forgotten.
  void run(const std::vector<std::size_t>& points, std::vector<SweepRow>& rows, StageClock& clock);

  /// Searches meshes for points that are known less well than a tolerance, the worst first; others that are
  /// too take the mesh where it knows them better. A point whose own search did no better keeps its row.
  /// @return the points whose rows are new
  std::vector<std::size_t> improve(std::vector<SweepRow>& rows, double tolerance, StageClock& clock);

private:
  /// What a mesh is searched for: a body as read, by a model of its own.
  struct Shape {
    BodyScene body;
    Method method;
  };
  struct Solution {
    std::size_t shape;
    Scene scene;                                             ///< as read, of its first point
    std::vector<std::shared_ptr<const BodyDesign>> designs;  ///< several where effects bring other loads
  };
  struct SweptBody {
    std::string name;
    std::vector<Shape> shapes;  ///< shapes; those that are searched twice stand here twice
    std::vector<Solution> solutions;
  };
  /// Copies of analyses that a thread works on.
  using Scratch = std::map<const BodyDesign*, Judged>;

  Solution& solution_of(std::size_t p, std::size_t b) { return bodies_[b].solutions[of_point_[p][b]]; }
  /// Whether another point has a point's solution of a body, or would be solved on its mesh.
  bool serves_others(std::size_t p, std::size_t b) const;
  bool has_a_solution_of_its_own(std::size_t p) const;
  void forget_solutions_of(std::size_t p);
  std::string design_bodies(std::size_t p, StageClock& clock);
  const BodyDesign* searched_design(std::size_t b, std::size_t i_shape) const;
  void solve_for(std::size_t p, StageClock& clock);
  const BodyDesign* keep_design(std::size_t p, std::size_t b, const Scene& before, SceneRun& run,
                                const BodyDesign* searched);
  bool needs_solution(std::size_t p, std::size_t b, const std::vector<const BodyDesign*>& on_mesh,
                      const Scene& scene, StageClock& clock);
  SceneRunOptions run_options() const;
  SceneRunOptions options_beside(const std::vector<const BodyDesign*>& others, std::size_t b);
  bool body_row(std::size_t p, SweepRow& row, Scratch& scratch);
  SweepRow row_once_solved(std::size_t p, StageClock& clock);
  void add_cheap(SweepRow& row, Scene scene, std::size_t b, const Loaded& loaded, Method method);
  bool is_met_at_its_own_point(const std::vector<SweepRow>& rows, std::size_t p, std::size_t b,
                               double tolerance) const;

  const SweepOptions& options_;
  ReadPoint read_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::size_t>> of_point_;  ///< by point and body: its solution
  std::vector<SweptBody> bodies_;
  std::map<std::vector<std::size_t>, std::string> refused_;  ///< by combination: why; empty: not
  std::size_t n_improved_ = 0;
  std::vector<std::string> cache_faults_;
  std::mutex cheap_;  ///< cheap models run one at a time: fem's threads are theirs
};

}  // namespace pipelines
