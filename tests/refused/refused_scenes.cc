/// Every *.toml in the folders beside `base` is a scene that must be refused, and says itself with which
/// errors: README.md describes its directives.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "pipelines/scene/whole/scene.h"

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

struct RefusedScene {
  std::string scene;                      // the edited text
  std::vector<std::string> expectations;  // "line:column: fragment"
};

RefusedScene load(const fs::path& file) {
  RefusedScene result{read(file), {}};
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto value_of = [&](const std::string& word) {
      const std::string prefix = "# " + word + ": ";
      return line.rfind(prefix, 0) == 0 ? line.substr(prefix.size()) : std::string();
    };
    if (const std::string base = value_of("BASE"); !base.empty()) {
      result.scene = read(fs::path(TEST_DATA) / "base" / base);
    } else if (const std::string edit = value_of("REPLACE"); !edit.empty()) {
      const auto arrow = edit.find(" -> ");
      const std::string old_text = edit.substr(0, arrow);
      std::string new_text = arrow == std::string::npos ? "" : edit.substr(arrow + 4);
      replace_all(new_text, "\\n", "\n");
      const auto at = result.scene.find(old_text);
      if (arrow == std::string::npos || at == std::string::npos ||
          result.scene.find(old_text, at + 1) != std::string::npos)
        throw std::runtime_error(file.string() + ": not exactly one place for: " + line);
      result.scene.replace(at, old_text.size(), new_text);
    } else if (const std::string expectation = value_of("EXPECT"); !expectation.empty()) {
      result.expectations.push_back(expectation);
    }
  }
  replace_all(result.scene, "@SOURCE@", SOURCE_DIR);
  return result;
}

/// "line:column: key = value: remedy"
std::string without_file(const pipelines::SceneFinding& error) {
  pipelines::SceneFinding local = error;
  local.file = "";
  const std::string text = local.text();
  return error.line == 0 ? "0:0" + text : text.substr(1);
}

bool fits(const pipelines::SceneFinding& error, const std::string& expectation) {
  const auto end_of_place = expectation.find(": ");
  const std::string text = without_file(error);
  return text.rfind(expectation.substr(0, end_of_place + 1), 0) == 0 &&
         text.find(expectation.substr(end_of_place + 2)) != std::string::npos;
}

std::vector<fs::path> refused_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(TEST_DATA))
    if (entry.path().extension() == ".toml" && entry.path().parent_path().filename() != "base")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class Refused : public testing::TestWithParam<fs::path> {};

TEST_P(Refused, WithTheExpectedErrors) {
  const RefusedScene wrong = load(GetParam());
  ASSERT_FALSE(wrong.expectations.empty()) << "no # EXPECT line in " << GetParam();
  const fs::path file =
      fs::path(testing::TempDir()) / (std::to_string(getpid()) + "_" + GetParam().filename().string());
  std::ofstream(file, std::ios::binary) << wrong.scene;
  std::vector<pipelines::SceneFinding> errors;
  try {
    pipelines::read_scene(file);
  } catch (const pipelines::SceneError& refused) {
    errors = refused.findings();
  }
  fs::remove(file);

  std::string report;
  for (const auto& error : errors) {
    report += without_file(error) + "\n";
    EXPECT_TRUE(error.file == file.string() || fs::path(error.file).extension() == ".csv") << error.file;
    EXPECT_FALSE(error.remedy.empty());
    const bool is_of_the_file = error.line == 0 || error.remedy.rfind("is not TOML", 0) == 0;
    EXPECT_TRUE(is_of_the_file || !error.key.empty()) << error.text();
  }
  EXPECT_EQ(errors.size(), wrong.expectations.size()) << report;
  for (const std::string& expectation : wrong.expectations)
    EXPECT_TRUE(
        std::any_of(errors.begin(), errors.end(), [&](const auto& e) { return fits(e, expectation); }))
        << "expected " << expectation << "\namong\n"
        << report;
}

INSTANTIATE_TEST_SUITE_P(scenes, Refused, testing::ValuesIn(refused_files()), [](const auto& test) {
  std::string name = test.param.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

/// What reading a text as a scene says; the CSV file of `table` lies beside it.
std::string refusal_of_text(const std::string& text, const std::string& table = "") {
  const fs::path folder = fs::path(testing::TempDir()) / ("refused_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "scene.toml", std::ios::binary) << text;
  std::ofstream(folder / "wide.csv", std::ios::binary) << table;
  std::string refusal = "accepted";
  try {
    pipelines::read_scene(folder / "scene.toml");
  } catch (const pipelines::SceneError& error) {
    refusal = error.what();
  }
  fs::remove_all(folder);
  return refusal;
}

std::string repeated(int n, const std::string& first, const std::string& last) {
  std::string text;
  for (int i = 0; i < n; ++i) text += first + std::to_string(i) + last;
  return text;
}

std::string base(const std::string& name, const std::string& from, const std::string& to) {
  std::string text = read(fs::path(TEST_DATA) / "base" / name);
  text.replace(text.find(from), from.size(), to);
  replace_all(text, "@SOURCE@", SOURCE_DIR);
  return text;
}

/// What is large and wrong is refused in a second's work (quadratic work would take minutes) and in few
/// words.
TEST(refused, LargeScenesAreRefusedSoonAndShort) {
  constexpr int n = 100'000;
  const std::string in_one_line = "debalance_shares = [" + repeated(n, "", ", ") + "]";
  const std::string tables =
      "contour = [" + repeated(n, "{ name = \"s", "\", diameter = 1, length = 1 }, ") + "] # ";
  const std::string scenes[] = {
      base("train.toml", "effects = [\"motor\"]", "effects = [" + repeated(n, "\"e", "\", ") + "]"),
      base("train.toml", "effects", repeated(n, "key_", " = 1\n") + "effects"),
      base("mill.toml", "debalance_shares = [0.5, 0.5]", in_one_line),
      base("mill.toml", "contour = [", tables + "\nremainder = ["),
      base("table.toml", "@SOURCE@/pipelines/scenes/belt_pull.csv", "wide.csv")};
  const std::string wide = "angle [deg],disc.fx [N]" + std::string(4000, ',') + "\n" +
                           repeated(4, "", ",1" + std::string(4000, ',') + "\n");
  for (const auto& scene : scenes) {
    const auto begin = std::clock();
    const std::string refusal = refusal_of_text(scene, wide);
    EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 10) << refusal.substr(0, 300);
    EXPECT_LT(refusal.size(), 10'000u) << refusal.substr(0, 300);
    EXPECT_NE(refusal, "accepted");
  }
}

TEST(refused, OfManyMistakesTheFirstTwentyAreTold) {
  const std::string refusal =
      refusal_of_text(base("train.toml", "effects", repeated(50, "k", " = 1\n") + "effects"));
  EXPECT_EQ(std::count(refusal.begin(), refusal.end(), '\n'), 20) << refusal;
  EXPECT_NE(refusal.find(":20:1: k19 = 1"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("and 30 more of 50 in all"), std::string::npos) << refusal;
}

TEST(refused, TheBasesOfTheRefusedScenesAreAccepted) {
  for (const auto& entry : fs::directory_iterator(fs::path(TEST_DATA) / "base")) {
    std::string scene = read(entry.path());
    replace_all(scene, "@SOURCE@", SOURCE_DIR);
    const fs::path file = fs::path(testing::TempDir()) /
                          (std::to_string(getpid()) + "_base_" + entry.path().filename().string());
    std::ofstream(file, std::ios::binary) << scene;
    EXPECT_NO_THROW(pipelines::read_scene(file)) << entry.path();
    fs::remove(file);
  }
}

}  // namespace
