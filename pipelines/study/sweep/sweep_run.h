/// Runs the points of a sweep. Points that differ in what the machine does share mesh and unit responses:
/// their load stage is computed and superposed. A body whose shape a point changes is meshed and solved anew,
/// that body alone; one whose material or springs it changes is solved anew on the mesh it has. Where a
/// tolerance was asked for, points that those meshes know less well get one of their own.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/variations/sweep_options.h"
#include "pipelines/study/variations/sweep_points.h"

namespace pipelines {

/// Told of points that are new, several at once.
/// @param rows  rows of all points
using SweepListener =
    std::function<void(const std::vector<std::size_t>& points, const std::vector<SweepRow>& rows)>;

class SweepRun {
public:
  /// Reads every point, but for those of the load stage alone that differ from others in numbers only. So all
  /// files that points name are noted as inputs.
  /// @throws SceneError if no point can be read: what is wrong with the first
  SweepRun(SweepOptions options, const std::vector<SweepPoint>& points);
  ~SweepRun();

  SweepForecast forecast() const;
  /// Points of one number share their meshes, or are read one after the other. Numbers ascend from 0 in the
  /// order of the points that first have them.
  /// @param n_shares  how many groups there shall be where no mesh is shared
  std::vector<std::size_t> groups(int n_shares) const;
  /// Computes only these points; run() leaves the rows of others as they are. Called once, before it.
  /// @param is_own  by point
  void keep_points(const std::vector<char>& is_own);
  /// Meshes that run() has searched beside those of the forecast, for points known less well.
  std::size_t n_improved_meshes() const;
  /// Sentences for the user: which unit responses run() could not leave in the cache, and why.
  const std::vector<std::string>& cache_faults() const;
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
