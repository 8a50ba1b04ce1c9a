/// The points of a sweep on several MPI ranks: each rank computes its share of them, rank 0 collects the
/// rows.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <list>
#include <vector>

#include "pipelines/study/sweep/sweep_run.h"
#include "pipelines/study/variations/sweep_points.h"

namespace pipelines {

/// The rank of each point: groups go to the ranks in turn, each as a whole.
/// @param group    group of each point, numbered from 0 without gaps (SweepRun::groups)
/// @param n_ranks  at least 1
std::vector<int> deal_points(const std::vector<std::size_t>& group, int n_ranks);

/// Sends rows from every rank but the first to rank 0, which may be long at its own points.
class RowsToFirstRank {
public:
  explicit RowsToFirstRank(const SweepPlan& plan) : plan_(plan) {}
  void send(const std::vector<std::size_t>& points, const std::vector<SweepRow>& rows);
  /// Ends the sending after the last row. Returns when rank 0 has them all.
  /// @param n_improved_meshes  the one of SweepRun
  void end(std::size_t n_improved_meshes);

private:
  struct Sent {
    std::vector<char> bytes;
    MPI_Request request;
  };
  void send(std::vector<char> bytes);

  const SweepPlan& plan_;
  std::list<Sent> sent_;
};

/// Receives on rank 0 the rows of other ranks.
class RowsOfOtherRanks {
public:
  /// @param n_ranks  the first included
  RowsOfOtherRanks(const SweepPlan& plan, int n_ranks) : plan_(plan), n_open_(n_ranks - 1) {}
  /// What has come, into the rows.
  void take(std::vector<SweepRow>& rows, const SweepListener& listener);
  /// Waits until all ranks have ended.
  void take_all(std::vector<SweepRow>& rows, const SweepListener& listener);
  /// Points whose rows have come.
  const std::vector<std::size_t>& points() const noexcept { return points_; }
  std::size_t n_improved_meshes() const noexcept { return n_improved_; }

private:
  const SweepPlan& plan_;
  std::vector<std::size_t> points_;
  int n_open_;  ///< ranks that have not ended
  std::size_t n_improved_ = 0;
};

}  // namespace pipelines
