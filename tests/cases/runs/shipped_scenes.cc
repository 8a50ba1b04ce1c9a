#include "tests/cases/program/program.h"

using namespace cases;

namespace {

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SOURCE_DIR) / "pipelines/scenes"))
    if (entry.path().extension() == ".toml") scenes.push_back("'" + entry.path().string() + "'");
  EXPECT_FALSE(scenes.empty());
  return scenes;
}

}  // namespace

// The loads of each scene that is shipped can be computed and read back.
TEST(ShippedScenes, GiveLoads) {
  const results_test::Directory directory;
  for (const auto& scene : shipped_scenes()) {
    const auto loads = millstress(directory.path, "loads " + scene + " -o loads.h5 --csv loads.csv --json");
    EXPECT_EQ(loads.exit_code, 0) << loads.err;
    EXPECT_FALSE(nlohmann::json::parse(loads.out)["loads"].empty());
    const auto columns = csv(directory / "loads.csv");
    EXPECT_FALSE(columns.at("time").empty());
    EXPECT_TRUE(fs::exists(directory / "loads.h5"));
  }
}

// Bodies are meshed, and what a search for them takes is forecast: seconds each.
TEST(ShippedScenes, AreForecast) {
  const results_test::Directory directory;
  for (const auto& scene : shipped_scenes()) {
    const auto check = millstress(directory.path, "check " + scene);
    EXPECT_EQ(check.exit_code, 0) << check.err;
    EXPECT_NE(check.out.find("the scene is valid"), std::string::npos);
  }
}

// The front page's scene is complete and runs as it stands there.
TEST(FrontPage, ItsSceneRuns) {
  const std::string page = results_test::bytes(fs::path(SOURCE_DIR) / "README.md");
  const auto begin = page.find("```toml\n") + 8;
  const results_test::Directory directory;
  write(directory / "my_shaft.toml", page.substr(begin, page.find("```", begin) - begin));
  const auto run = as_a_user(directory.path, "run my_shaft.toml");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto shaft = summary(directory / "results/my_shaft")["bodies"]["shaft"];
  const auto printed = page.find("peak von Mises stress 43.1 MPa");
  EXPECT_NE(printed, std::string::npos);
  EXPECT_NEAR(shaft["governing"]["value"].get<double>(), 43.1e6, 0.05e6) << "as the page prints it";
}

// A front page is read to its end: 150 lines, none wider than 100 columns but for pictures and what the
// program prints.
TEST(FrontPage, IsShort) {
  std::istringstream page(results_test::bytes(fs::path(SOURCE_DIR) / "README.md"));
  int n = 0;
  bool is_output = false;
  for (std::string line; std::getline(page, line);) {
    ++n;
    if (line.rfind("```", 0) == 0) is_output = line == "```text";
    if (is_output || line.rfind("![", 0) == 0) continue;
    EXPECT_LE(line.size(), 100u) << line;
  }
  EXPECT_LE(n, 150);
}
