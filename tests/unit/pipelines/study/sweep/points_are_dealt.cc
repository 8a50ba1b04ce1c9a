/// Which points of a sweep an MPI rank computes.
#include <gtest/gtest.h>

#include "pipelines/scene/reader/scene_tree.h"
#include "pipelines/study/sweep/points_on_ranks.h"

using namespace pipelines;

namespace {

std::vector<std::size_t> groups_of(const std::string& scene, const std::vector<std::string>& vary,
                                   bool loads_only, int n_shares) {
  const auto path = std::filesystem::path(SOURCE_DIR) / "pipelines/scenes" / scene;
  SweepRequest request;
  request.vary = vary;
  SweepOptions options;
  options.scene = path;
  options.tree = read_scene_tree(path);
  options.settings = {"chamber=removed"};
  options.n_threads = 1;
  options.loads_only = loads_only;
  return SweepRun(options, plan_sweep(request).points).groups(n_shares);
}

using Groups = std::vector<std::size_t>;

}  // namespace

TEST(PointsOfASweep, OfOneMeshStayOnOneRank) {
  EXPECT_EQ(deal_points({0, 1, 2, 0, 1, 2, 3}, 3), (std::vector<int>{0, 1, 2, 0, 1, 2, 0}));
  EXPECT_EQ(deal_points({0, 0, 1}, 4), (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(deal_points({}, 4), std::vector<int>());
}

TEST(PointsOfASweep, ShareTheMeshOfTheirDiameter) {
  const std::vector<std::string> vary{"shaft.material.youngs_modulus = 200 GPa, 210 GPa",
                                      "shaft.contour[9].diameter = 58 mm, 60 mm, 62 mm"};
  EXPECT_EQ(groups_of("vibratory_mill.toml", vary, false, 2), (Groups{0, 1, 2, 0, 1, 2}));
}

TEST(PointsOfASweep, OfTheLoadStageFollowEachOther) {
  EXPECT_EQ(groups_of("vibratory_mill.toml", {"machine.drive.speed = 1200..1600 rpm / 5"}, true, 2),
            (Groups{0, 0, 0, 1, 1}));
}
