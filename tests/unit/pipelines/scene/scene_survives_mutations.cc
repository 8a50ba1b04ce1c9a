#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "pipelines/scene/scene.h"

namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Deletes, doubles, moves or alters one line; the generator alone decides, so the same seed gives the same
/// scenes.
void mutate(std::vector<std::string>& lines, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  static const std::vector<std::string> pieces = {
      "\"", "[", "]",    "=",  "-",          "1e999", "nan",     "{",      "}",      ",",
      "mm", "#", "\t",   "\\", "9999999999", "0",     "Hz",      "\"\"",   "[[",     "true",
      "°",  ".", "-1/0", "''", "1979-05-27", "inf",   "machine", "fillet", "\"\"\"", "= ["};
  const std::size_t at = below(lines.size());
  const auto here = lines.begin() + static_cast<std::ptrdiff_t>(at);
  switch (below(6)) {
    case 0:
      lines.erase(here);
      break;
    case 1:
      lines.insert(here, std::string(*here));
      break;
    case 2:
      std::swap(lines[at], lines[below(lines.size())]);
      break;
    case 3:
      here->insert(below(here->size() + 1), pieces[below(pieces.size())]);
      break;
    case 4:
      if (!here->empty()) here->erase(below(here->size()), 1 + below(4));
      break;
    default:
      for (char& c : *here)
        if (c >= '0' && c <= '9' && below(2) == 0) c = static_cast<char>('0' + below(10));
  }
}

class EveryScene : public testing::TestWithParam<const char*> {};

TEST_P(EveryScene, MutatedIsReadOrRefusedAndNothingElse) {
  const auto original =
      lines_of(fs::path(SOURCE_DIR) / "pipelines/scenes" / (GetParam() + std::string(".toml")));
  const fs::path file =
      fs::path(testing::TempDir()) / ("mutated_" + std::to_string(getpid()) + "_" + GetParam() + ".toml");
  std::mt19937 random(20240229);
  int n_read = 0, n_refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<std::string> lines = original;
    const std::size_t n_mutations = 1 + static_cast<std::size_t>(random()) % 3;
    for (std::size_t m = 0; m < n_mutations; ++m) mutate(lines, random);
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    std::ofstream(file, std::ios::binary) << text;
    try {
      pipelines::read_scene(file);
      ++n_read;
    } catch (const pipelines::SceneError& refused) {
      ++n_refused;
      EXPECT_FALSE(refused.findings().empty());
      for (const auto& error : refused.findings()) {
        EXPECT_FALSE(error.remedy.empty()) << text;
        EXPECT_LE(error.line, static_cast<int>(lines.size()) + 1) << error.text();
        EXPECT_TRUE(error.line > 0 || error.remedy.find("empty") != std::string::npos) << error.text();
      }
    } catch (const std::exception& other) {
      ADD_FAILURE() << "mutation " << i << ": " << other.what() << "\n" << text;
    }
  }
  fs::remove(file);
  EXPECT_GT(n_read, 30) << "many mutations touch comments or stay within reason";
  EXPECT_GT(n_refused, 100);
}

INSTANTIATE_TEST_SUITE_P(shipped, EveryScene,
                         testing::Values("vibratory_mill", "planetary_mill", "stub_axle", "drive_train",
                                         "root_peeler_shaft"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
