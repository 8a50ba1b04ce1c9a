/// Runs the points of a sweep. Points that differ in what the machine does share mesh and unit responses:
/// their load stage is computed and superposed. A body whose shape a point changes is meshed and solved anew,
/// that body alone; one whose material or springs it changes is solved anew on the mesh it has.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/common/stage_clock.h"
#include "pipelines/files/toml_tree.h"
#include "pipelines/scene/requested_accuracy.h"
#include "pipelines/sweep/sweep_points.h"
#include "pipelines/sweep/sweep_row.h"

namespace pipelines {

struct SweepOptions {
  std::filesystem::path scene;
  TomlNode tree;                      ///< of the scene
  std::vector<std::string> settings;  ///< of all points: --set
  std::filesystem::path directory;    ///< meshes and unit responses go into its folder bodies
  int n_threads = 0;                  ///< 0: all cores
  bool loads_only = false;
  bool fresh = false;
  RequestedAccuracy accuracy{};  ///< of every mesh that is searched
};

/// What a sweep will take, before it takes it.
struct SweepForecast {
  std::size_t n_points = 0;  ///< that can be read
  struct Body {
    std::string name;
    std::size_t n_meshes = 0;     ///< of different shape
    std::size_t n_solutions = 0;  ///< of different material or springs, those on new meshes included
  };
  std::vector<Body> bodies;  ///< none: the load stage alone
};

/// Told of points that are new, several at once.
/// @param rows  of all points
using SweepListener =
    std::function<void(const std::vector<std::size_t>& points, const std::vector<SweepRow>& rows)>;

class SweepRun {
public:
  /// Reads every point.
  /// @throws SceneError if no point can be read: what is wrong with the first
  SweepRun(SweepOptions options, const std::vector<SweepPoint>& points);
  ~SweepRun();

  SweepForecast forecast() const;
  /// Effects that the program would choose (effects = "auto") are all on in a sweep.
  bool has_chosen_effects() const;

  /// @param known   rows of an earlier run, by point; empty ones are computed
  /// @return a row for each point, in their order. One that fails has the reason in SweepRow::refused
  /// @throws what a run throws where no point of a body can be computed without (a disk that is full...)
  std::vector<SweepRow> run(StageClock& clock, std::vector<std::optional<SweepRow>> known,
                            const SweepListener& listener);

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pipelines
