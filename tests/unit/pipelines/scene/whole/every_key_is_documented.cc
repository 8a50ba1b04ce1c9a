/// The reference of scene keys, pipelines/scenes/README.md and the pages that it names, against the reader
/// itself.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "pipelines/scene/whole/scene.h"

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The words in backticks, in the tables' first column or anywhere on the pages, headings included.
std::set<std::string> documented_names(bool first_column_only) {
  std::stringstream page;
  for (const char* room :
       {"scenes", "scene/machines", "scene/tables", "scene/materials", "scene/bodies", "loads/bodies"})
    page << text_of(fs::path(SOURCE_DIR) / "pipelines" / room / "README.md");
  std::set<std::string> names;
  const std::regex quoted("`([^`]+)`"), word("[a-z_0-9]+");
  for (std::string line; std::getline(page, line);) {
    std::string text = line;
    if (first_column_only) {
      if (line.rfind("| ", 0) != 0) continue;
      text = line.substr(2, line.find(" |", 2) - 2);
    }
    for (std::sregex_iterator q(text.begin(), text.end(), quoted), none; q != none; ++q) {
      const std::string key = (*q)[1];
      for (std::sregex_iterator w(key.begin(), key.end(), word); w != none; ++w) names.insert(w->str());
    }
  }
  return names;
}

/// All that the reader knows, over the shipped scenes and those that the refused ones are made from.
std::set<std::string> known_keys() {
  std::set<std::string> keys;
  const fs::path source(SOURCE_DIR);
  for (const auto& folder : {source / "pipelines/scenes", source / "tests/refused/base"})
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".toml") continue;
      auto text = text_of(entry.path());
      for (std::size_t at; (at = text.find("@SOURCE@")) != std::string::npos;)
        text.replace(at, 8, SOURCE_DIR);
      const auto copy = entry.path().parent_path() == source / "pipelines/scenes"
                            ? entry.path()
                            : fs::path(testing::TempDir()) /
                                  (std::to_string(getpid()) + "_keys_" + entry.path().filename().string());
      if (copy != entry.path()) std::ofstream(copy, std::ios::binary) << text;
      for (const auto& key : pipelines::read_scene(copy).known_keys) keys.insert(key);
      if (copy != entry.path()) fs::remove(copy);
    }
  return keys;
}

}  // namespace

// A key that the reader knows and the page does not is one that nobody finds. Below `pressure` keys are
// ports.
TEST(SceneKeys, EveryOneIsDocumented) {
  const auto documented = documented_names(false);
  ASSERT_GT(documented.size(), 150u);
  for (const auto& key : known_keys()) {
    if (std::regex_search(key, std::regex("pressure\\.[a-z_0-9]+$"))) continue;
    const auto name = std::regex_replace(key.substr(key.rfind('.') + 1), std::regex("\\[.*"), "");
    EXPECT_TRUE(documented.count(name)) << key << " is not in the pages of keys";
  }
}

// A key that the tables have and no reader names is one that is refused.
TEST(SceneKeys, NoneIsInvented) {
  std::string readers;
  for (const char* room :
       {"scene/bodies", "scene/reader", "scene/tables", "scene/machines", "scene/kinds", "study/variations"})
    for (const auto& entry : fs::directory_iterator(fs::path(SOURCE_DIR) / "pipelines" / room))
      if (entry.path().extension() == ".cc") readers += text_of(entry.path());
  for (const auto& name : documented_names(true))
    EXPECT_NE(readers.find('"' + name), std::string::npos) << name;
}
