/// What all models of one accuracy study share: the scene with its meshes, the clock, how a run becomes a
/// row.
#pragma once

#include <chrono>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fem/base/common/memory.h"
#include "pipelines/base/common/refusal_of.h"
#include "pipelines/judge/estimates/in_time.h"
#include "pipelines/search/loop/scene_run.h"
#include "pipelines/study/accuracy/accuracy.h"

namespace pipelines {

/// A run of one solid mesh, and its row.
struct SolidRun {
  AccuracyRow row;
  SceneRun run;
};

class AccuracyBench {
public:
  /// Meshes all bodies of the scene.
  AccuracyBench(const Scene& scene, std::size_t body, const AccuracyOptions& options, StageClock& clock);
  AccuracyBench(const AccuracyBench&) = delete;
  AccuracyBench& operator=(const AccuracyBench&) = delete;

  const Scene& scene() const { return scene_; }
  std::size_t index() const { return body_; }
  const BodyScene& body() const { return scene_.bodies[body_]; }
  const std::vector<MeshedBody>& meshed() const { return meshed_; }  ///< at the scene's own fineness
  const MeshedBody& own() const { return meshed_[body_]; }
  const AccuracyOptions& options() const { return options_; }
  bool has_hot_spots() const { return !own().mesh.hot_spots.empty(); }

  double tolerance() const;  ///< tolerance of the options, else of the scene, else 5 %
  /// Error, relative to the value, below which no finer run is made.
  double overkill() const { return 0.1 * tolerance(); }
  double elapsed_s() const;
  double seconds_left() const { return options_.time_limit_s - elapsed_s(); }

  SceneRunOptions run_options() const;  ///< options of this body alone, without the cache

  /// Runs the work as one stage of the study; its own stages go into its row.
  template <typename Work>
  auto timed(const std::string& name, Work&& work) {
    return clock_.run(name, [&] {
      fem::release_free_memory();  // memory of the run before
      forget_peak_memory();
      return work();
    });
  }

  /// The run `repeats` times, as long as it takes less than a tenth of the time.
  /// @param run  returns its row, with its seconds
  template <typename Run>
  AccuracyRow repeated(const std::string& name, Run&& run) {
    return timed(name, [&] {
      std::vector<double> seconds;
      AccuracyRow row;
      do {
        row = run();
        seconds.push_back(row.seconds);
      } while (int(seconds.size()) < options_.n_repeats && row.seconds < 0.1 * options_.time_limit_s);
      take_mean(row, seconds);
      return row;
    });
  }

  /// Work that adds to the study, or is among what is left out, with the reason: a mesh is refused, cannot be
  /// solved, or the time is up before it is done. The first one has all the time that it takes, since there
  /// would be no study without it.
  /// @return whether it was done
  template <typename Work>
  bool is_done(const std::string& name, Work&& work) {
    const double seconds = has_any_ ? seconds_left() : std::numeric_limits<double>::infinity();
    std::string why = seconds > 0 ? "" : "no time is left for it";
    if (why.empty() && !in_time(seconds, [&] { why = refusal_of(work); }))
      why = "the time was up before it was done";
    if (why.empty())
      has_any_ = true;
    else
      leave_out(name, why);
    return why.empty();
  }

  /// The scene with `body` in the place of the studied one, from mesh to stress.
  /// @param name  name of the stage that shows
  /// @return nothing if the mesh is refused or cannot be solved; then it is among those left out
  std::optional<SolidRun> run_solid(const std::string& model, const std::string& name, const BodyScene& body);

  void leave_out_for_time(const std::string& name, double predicted_s, double left_s);
  void leave_out(const std::string& name, const std::string& why) { left_out_.push_back({name, why}); }
  const std::vector<LeftOutModel>& left_out() const { return left_out_; }

private:
  static void take_mean(AccuracyRow& row, const std::vector<double>& seconds);

  Scene scene_;
  std::size_t body_;
  AccuracyOptions options_;
  StageClock& clock_;
  std::chrono::steady_clock::time_point start_;
  std::vector<MeshedBody> meshed_;
  bool has_any_ = false;  ///< whether a run has ended
  std::vector<LeftOutModel> left_out_;
};

/// Governing stress, budget and mesh of a run of one body.
AccuracyRow row_of(const std::string& model, const SceneRun& run);

/// Stages, seconds and memory of a run.
void take_cost(AccuracyRow& row, const StageClock& clock);

double total_seconds(const std::vector<StageCost>& stages);

}  // namespace pipelines
