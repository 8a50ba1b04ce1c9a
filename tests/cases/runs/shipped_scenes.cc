#include <algorithm>
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

/// Word by word; numbers to 2e-3, which another processor's rounding and choice of kernels stay within. What
/// they choose, such as one of many equal instants, the page leaves out.
/// @param b  the page's; words after an ellipsis at its end are not compared
bool is_same_line(const std::string& a, const std::string& b) {
  const auto words = [](const std::string& line) {
    std::istringstream in(line);
    return std::vector<std::string>{std::istream_iterator<std::string>(in), {}};
  };
  auto x = words(a), y = words(b);
  if (!y.empty() && y.back() == "..." && x.size() >= y.size()) {
    y.pop_back();
    x.resize(y.size());
  }
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

/// Folder and name of a quoted path: "papers/vibratory_mill".
std::string name_of(const std::string& scene) {
  const fs::path file(scene);
  return (file.parent_path().filename() / file.stem()).string();
}

/// What all releases have to agree on, as Debian 12 has it: tests/data/release_figures.json, a part of it.
/// With MILLSTRESS_NEW_FIGURES set the part is written anew at the end.
class ReleaseFigures {
public:
  explicit ReleaseFigures(std::string part) : part_(std::move(part)) {
    expected_ = nlohmann::json::parse(results_test::bytes(file_));
  }
  ~ReleaseFigures() {
    if (std::getenv("MILLSTRESS_NEW_FIGURES") == nullptr) {
      EXPECT_EQ(found_.size(), expected_[part_].size()) << "a figure is gone";
      return;
    }
    expected_[part_] = found_;
    write(file_, expected_.dump(1) + "\n");
  }
  ReleaseFigures(const ReleaseFigures&) = delete;
  ReleaseFigures& operator=(const ReleaseFigures&) = delete;

  void hold(const std::string& name, double value, double tolerance) {
    found_[name] = value;
    if (std::getenv("MILLSTRESS_NEW_FIGURES") != nullptr) return;
    ASSERT_TRUE(expected_[part_].contains(name)) << name;
    EXPECT_NEAR(value, expected_[part_][name].get<double>(), tolerance) << name;
  }

private:
  const fs::path file_ = fs::path(SOURCE_DIR) / "tests/data/release_figures.json";
  std::string part_;
  nlohmann::json expected_, found_ = nlohmann::json::object();
};

}  // namespace

// The loads of each scene that is shipped can be computed and read back, and are the same on every release:
// 1e-8 of a load's largest value, where libraries differ by rounding.
TEST(ShippedScenes, GiveLoads) {
  const results_test::Directory directory;
  ReleaseFigures expected("loads");
  for (const auto& scene : shipped_scenes()) {
    const auto loads = millstress(directory.path, "loads " + scene + " -o loads.h5 --csv loads.csv --json");
    EXPECT_EQ(loads.exit_code, 0) << loads.err;
    const auto found = nlohmann::json::parse(loads.out)["loads"];
    EXPECT_FALSE(found.empty());
    for (const auto& [name, load] : found.items()) {
      const double size = std::max(std::abs(load["max"].get<double>()), std::abs(load["min"].get<double>()));
      for (const char* figure : {"max", "min", "rms"})
        expected.hold(name_of(scene) + "/" + name + "/" + figure, load[figure], 1e-8 * size);
    }
    const auto columns = csv(directory / "loads.csv");
    EXPECT_FALSE(columns.at("time").empty());
    EXPECT_TRUE(fs::exists(directory / "loads.h5"));
  }
}

// Stresses are the same on every release: 1e-6 where the mesh is the same, else within both errors.
TEST(ShippedScenes, HaveOneStressOnEachRelease) {
  const results_test::Directory directory;
  ReleaseFigures expected("stress");
  for (const std::string run :
       {"shaft.toml --method beam", "shaft.toml --method axisymmetric", "stub_axle.toml", "part.toml"}) {
    const auto outcome = millstress(directory.path, "run -q --force -o r " + shipped(run).string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto bodies = summary(directory / "r")["bodies"];
    EXPECT_FALSE(bodies.empty());
    for (const auto& [body, result] : bodies.items()) {
      const auto& stress = result["governing"];
      const bool is_same_mesh = run != "part.toml";  // gmsh's own tetrahedra differ from release to release
      const double value = stress["value"], error = stress["error"]["total"];
      expected.hold(run + "/" + body, value, is_same_mesh ? 1e-6 * value : 2 * error);
    }
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
