#include "tests/cases/program.h"

using namespace cases;

// Each scene that is shipped is valid, and its loads can be computed and read back.
TEST(ShippedScenes, AreValidAndGiveLoads) {
  const results_test::Directory directory;
  int n = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(SOURCE_DIR) / "pipelines/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    ++n;
    const std::string scene = "'" + entry.path().string() + "'";
    const auto check = millstress(directory.path, "check " + scene);
    EXPECT_EQ(check.exit_code, 0) << check.err;
    EXPECT_NE(check.out.find("the scene is valid"), std::string::npos);
    const auto loads = millstress(directory.path, "loads " + scene + " -o loads.h5 --csv loads.csv --json");
    EXPECT_EQ(loads.exit_code, 0) << loads.err;
    EXPECT_FALSE(nlohmann::json::parse(loads.out)["loads"].empty());
    const auto columns = csv(directory / "loads.csv");
    EXPECT_FALSE(columns.at("time").empty());
    EXPECT_TRUE(fs::exists(directory / "loads.h5"));
  }
  EXPECT_GT(n, 0);
}
