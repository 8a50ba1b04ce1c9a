/// Long work asks for the time while it is at work.
#include "fem/base/common/deadline.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <atomic>
#include <cmath>

#include "fem/base/common/parallel.h"
#include "fem/equations/matrices/cholmod_factor.h"

namespace {

using fem::Deadline;
using fem::OutOfTime;

constexpr double far_s = 1000;

// Red if the inner of two replaces the outer, or stays after its scope.
TEST(Deadlines, TheEarliestCountsAsLongAsItLives) {
  EXPECT_NO_THROW(fem::require_time());
  EXPECT_TRUE(std::isinf(fem::seconds_to_deadline()));
  {
    const Deadline outer(0);
    const Deadline inner(far_s);
    EXPECT_THROW(fem::require_time(), OutOfTime);
  }
  {
    const Deadline outer(far_s);
    { const Deadline inner(0); }
    EXPECT_NO_THROW(fem::require_time());
    EXPECT_THROW(fem::require_time(2 * far_s), OutOfTime);
    EXPECT_NEAR(fem::seconds_to_deadline(), far_s, 60);
  }
  EXPECT_NO_THROW(fem::require_time(2 * far_s));
}

// Red where loops do not ask.
TEST(Deadlines, EndALoop) {
  std::atomic<int> n_done{0};
  const auto count = [&](std::size_t begin, std::size_t end) { n_done += int(end - begin); };
  {
    const Deadline deadline(0);
    EXPECT_THROW(fem::parallel_for(10'000, 1, count), OutOfTime);
    EXPECT_EQ(n_done, 0);
  }
  fem::parallel_for(10'000, 1, count);
  EXPECT_EQ(n_done, 10'000);
}

/// A chain of nodes, each coupled with all before it: as many flops as a full matrix has.
fem::NodeGraph full_graph(int n) {
  fem::NodeGraph graph;
  graph.begin.push_back(0);
  for (int j = 0; j < n; ++j) {
    for (int i = j + 1; i < n; ++i) graph.neighbour.push_back(i);
    graph.begin.push_back(std::int64_t(graph.neighbour.size()));
  }
  return graph;
}

// A factorisation cannot be ended: it is not begun where its flops, at the pace of the last piece of work,
// would take longer than there is. Red where the pace is not asked: 400 nodes take a hundredth of a second.
TEST(Deadlines, AFactorIsNotBegunThatWouldNotEnd) {
  const auto graph = full_graph(400);
  fem::CholmodFactor factor(graph, fem::order_nodes(graph));
  fem::note_pace(1, 1);
  fem::SymmetricMatrix matrix = fem::make_matrix(graph);
  matrix.value.setZero();
  for (Eigen::Index j = 0; j < Eigen::Index(matrix.n); ++j)
    matrix.value[Eigen::Index(matrix.column_begin[std::size_t(j)])] = 1;
  const Deadline deadline(far_s);
  EXPECT_NO_THROW(factor.factorise_in_order(matrix));
  fem::note_pace(1, 1e9);
  EXPECT_THROW(factor.factorise_in_order(matrix), OutOfTime);
  fem::note_pace(1, 1);
}

}  // namespace
