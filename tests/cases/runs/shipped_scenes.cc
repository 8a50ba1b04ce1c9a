#include <cmath>
#include <cstdlib>
#include <iterator>
#include <sstream>

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

/// Word by word; numbers to 2e-3, which another processor's rounding and choice of kernels stay within.
bool is_same_line(const std::string& a, const std::string& b) {
  const auto words = [](const std::string& line) {
    std::istringstream in(line);
    return std::vector<std::string>{std::istream_iterator<std::string>(in), {}};
  };
  const auto x = words(a), y = words(b);
  if (x.size() != y.size()) return false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    char *end_x = nullptr, *end_y = nullptr;
    const double u = std::strtod(x[i].c_str(), &end_x), v = std::strtod(y[i].c_str(), &end_y);
    const bool are_numbers = end_x != x[i].c_str() && std::string(end_x) == end_y;
    if (are_numbers ? std::abs(u - v) > 2e-3 * std::abs(v) : x[i] != y[i]) return false;
  }
  return true;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
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

// The front page's scene is complete, and prints what stands there. Turns red: a figure, a word or a line
// that the program prints otherwise.
TEST(FrontPage, ItsScenePrintsWhatThePageSays) {
  const std::string page = results_test::bytes(fs::path(SOURCE_DIR) / "README.md");
  const auto block = [&](const std::string& fence) {
    const auto begin = page.find(fence) + fence.size();
    return page.substr(begin, page.find("```", begin) - begin);
  };
  const results_test::Directory directory;
  write(directory / "my_shaft.toml", block("```toml\n"));
  const auto run = as_a_user(directory.path, "run my_shaft.toml");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::istringstream wanted(block("```text\n"));
  std::size_t at = 0;
  const auto printed = lines_of(run.out);
  for (std::string line; std::getline(wanted, line);) {
    while (at < printed.size() && !is_same_line(printed[at], line)) ++at;
    ASSERT_LT(at, printed.size()) << line << "\n" << run.out;
  }
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
