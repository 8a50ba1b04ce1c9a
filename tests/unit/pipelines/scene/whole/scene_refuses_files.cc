/// Files that are no scenes. Scenes with wrong content: tests/refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "pipelines/base/files/toml_tree.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/whole/scene.h"

namespace {

namespace fs = std::filesystem;

std::string refusal(const fs::path& file) {
  try {
    pipelines::read_scene(file);
    return "accepted";
  } catch (const pipelines::SceneError& refused) {
    EXPECT_EQ(refused.findings().size(), 1u);
    EXPECT_EQ(refused.findings()[0].line, 0);
    EXPECT_EQ(std::string(refused.what()), refused.findings()[0].text());
    return refused.what();
  }
}

/// A file that goes when the test ends.
struct ScratchFile {
  fs::path path;
  ~ScratchFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  operator const fs::path&() const { return path; }
};

ScratchFile written(const std::string& name, const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / (std::to_string(getpid()) + "_" + name);
  std::ofstream(file, std::ios::binary) << text;
  return {file};
}

TEST(scene_file, Missing) {
  EXPECT_EQ(refusal("/nowhere/scene.toml"),
            "/nowhere/scene.toml: there is no such file; give the path of a scene, such as "
            "pipelines/scenes/vibratory_mill.toml");
}

TEST(scene_file, Directory) {
  EXPECT_NE(refusal(testing::TempDir()).find("is a directory; give the path of a scene"), std::string::npos);
}

TEST(scene_file, EmptyOrOnlyComments) {
  EXPECT_NE(refusal(written("empty.toml", "")).find("the scene is empty"), std::string::npos);
  EXPECT_NE(refusal(written("comments.toml", "# nothing\n\n")).find("the scene is empty"), std::string::npos);
}

TEST(scene_file, Device) {
  EXPECT_NE(refusal("/dev/zero").find("no ordinary file"), std::string::npos);
}

TEST(scene_file, Unreadable) {
  const ScratchFile file = written("unreadable.toml", "title = \"secret\"\n");
  fs::permissions(file.path, fs::perms::none);
  const bool is_root = geteuid() == 0;  // who may read every file, and so becomes somebody else for once
  ASSERT_EQ(is_root ? seteuid(65534) : 0, 0);
  const std::string message = refusal(file);
  ASSERT_EQ(is_root ? seteuid(0) : 0, 0);
  EXPECT_NE(message.find("cannot be read; check its permissions"), std::string::npos) << message;
}

TEST(scene_file, BytesThatAreNoText) {
  const ScratchFile file = written("bytes.toml", std::string("a = 1\n\xff\xfe\x00\x01", 10));
  EXPECT_THROW(pipelines::read_scene(file), pipelines::SceneError);
}

// Editors of Windows save such files. Red where the parser says of them only that a sign is missing.
TEST(scene_file, InAnotherEncodingIsNamed) {
  const auto message = [](const std::string& bytes) {
    const ScratchFile file = written("encoded.toml", bytes);
    try {
      pipelines::read_scene(file);
    } catch (const pipelines::SceneError& refused) {
      return std::string(refused.what());
    }
    return std::string("accepted");
  };
  const std::string text = "title = \"a\"\nx = 1\n";
  std::string wide = "\xff\xfe";
  for (const char c : text) wide += std::string{c, '\0'};
  EXPECT_NE(message(wide).find(":1:1: is not TOML: it is written in UTF-16 LE"), std::string::npos)
      << message(wide);
  const std::string latin = message("title = \"a\"\nx = \"M\xC3\xBChle, M\xFChle\"\n");
  EXPECT_NE(latin.find(":2:14: is not TOML: the byte 0xFC is no UTF-8, perhaps Windows-1252"),
            std::string::npos)
      << latin;
}

TEST(toml_tree, KnowsWhereValuesStandAndHowTheyWereWritten) {
  const auto tree =
      pipelines::parse_toml("title = 'Mühle' # ü\r\n[a]\nx = [ 1_000, \"µ\",  0x10 ]\r\nb.c = 1.50e3\n");
  const auto& title = tree.find("title")->value;
  EXPECT_EQ(title.text, "Mühle");
  EXPECT_EQ(title.as_written, "'Mühle'");
  const auto& a = tree.find("a")->value;
  const auto& items = a.find("x")->value.items;
  EXPECT_EQ(items[0].as_written, "1_000");
  EXPECT_EQ(items[0].integer, 1000);
  EXPECT_EQ(items[2].as_written, "0x10");
  EXPECT_EQ(items[2].at.line, 3);
  EXPECT_EQ(items[2].at.column, 20) << "in characters, not bytes";
  EXPECT_EQ(a.find("b")->value.find("c")->value.as_written, "1.50e3");
  EXPECT_EQ(a.find("nothing"), nullptr);
}

TEST(nearest_name, SuggestsOnlyWhatIsNear) {
  const std::vector<std::string> known = {"mass", "offset", "turn_ratio", "charge_translation"};
  EXPECT_EQ(pipelines::nearest_name("mas", known), "mass");
  EXPECT_EQ(pipelines::nearest_name("Offset", known), "offset");
  EXPECT_EQ(pipelines::nearest_name("turnratio", known), "turn_ratio");
  EXPECT_EQ(pipelines::nearest_name("charge_trnaslation", known), "charge_translation");
  EXPECT_EQ(pipelines::nearest_name("colour", known), "");
  EXPECT_EQ(pipelines::nearest_name("", known), "");
  EXPECT_EQ(pipelines::nearest_name(std::string(100000, 'x'), known), "");
}

// The parser follows such names by recursion: 50,000 parts ended the program by a signal.
TEST(toml_tree, NamesHaveAHundredPartsAtMost) {
  const auto name_of = [](int n_parts) {
    std::string name = "a";
    for (int i = 1; i < n_parts; ++i) name += i % 2 == 0 ? ".a" : " . \"a\"";
    return name;
  };
  EXPECT_NO_THROW(
      pipelines::parse_toml("[" + name_of(100) + "]\n# ......\nx = [1.5, 2.5] # " + std::string(1000, '.')));
  for (const int n_parts : {101, 100'000}) try {
      pipelines::parse_toml("b = 1\n[" + name_of(n_parts) + "]\n");
      ADD_FAILURE() << n_parts;
    } catch (const pipelines::TomlSyntaxError& error) {
      EXPECT_EQ(error.at().line, 2);
      EXPECT_NE(std::string(error.what()).find("more than 100 parts"), std::string::npos);
    }
}

}  // namespace
