// What results may replace.
#include <gtest/gtest.h>

#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/replaceable.h"
#include "tests/unit/pipelines/examples/staged_samples.h"

using namespace staged_samples;
using results_test::Directory;

namespace {

// A list that leads out of the directory would let a damaged manifest remove what is not its own.
TEST(StagedResults, AManifestDoesNotReachOutOfItsDirectory) {
  for (const char* name :
       {"../mine.csv", "shaft/../../mine.csv", "/etc/passwd", ".bashrc", "shaft/.hidden", "."}) {
    const Directory at;
    std::ofstream(at / "mine.csv") << "mine";
    publish_first(at / "results");
    auto list = *read_manifest(OpenDirectory::at(at / "results"));
    list[name] = {4, text_hash("mine")};
    write_list(at / "results/manifest.json", list);
    EXPECT_TRUE(check_manifest(at / "results").damaged) << name;
    expect_in(refusal(at / "results"),
              "manifest.json: is there already, and is damaged or none of this program");
    EXPECT_EQ(bytes(at / "mine.csv"), "mine");
    EXPECT_EQ(bytes(at / "results/loads.csv"), "first");
  }
}

TEST(StagedResults, RefuseWhatIsNotTheirs) {
  const Directory at;
  fs::create_directories(at / "foreign");
  std::ofstream(at / "foreign/loads.csv") << "mine";
  expect_in(refusal(at / "foreign"), "foreign/loads.csv: is there already");
  EXPECT_EQ(visible_files(at / "foreign"), (Files{{"loads.csv", "mine"}}));
  EXPECT_EQ(std::distance(fs::directory_iterator(at / "foreign"), {}), 1);

  publish_first(at / "links");
  fs::rename(at / "links/shaft/zones.csv", at / "elsewhere.csv");
  fs::create_symlink(at / "elsewhere.csv", at / "links/shaft/zones.csv");
  expect_in(refusal(at / "links"), "links/shaft/zones.csv: is a symbolic link");
  EXPECT_EQ(bytes(at / "elsewhere.csv"), "first");
  EXPECT_EQ(bytes(at / "links/loads.csv"), "first");

  publish_first(at / "inputs");
  note_input(at / "inputs/loads.csv");
  expect_in(refusal(at / "inputs"), "inputs/loads.csv: is an input of this run");
  EXPECT_EQ(bytes(at / "inputs/loads.csv"), "first");
}

// A manifest of something else, or one of this program beside a file that it does not list as it is.
TEST(StagedResults, AManifestHasToBeTheirsAndListTheFile) {
  const Directory at;
  const auto checked = [&](const fs::path& directory, const std::string& part) {
    const auto before = visible_files(directory);
    expect_in(refusal(directory), part);
    EXPECT_EQ(visible_files(directory), before);
  };
  for (const char* text : {"{\"name\": \"an app\"}", "{}", "[]", "no JSON", ""}) {
    fs::create_directories(at / "app");
    std::ofstream(at / "app/manifest.json") << text;
    checked(at / "app", "manifest.json: is there already");
    std::ofstream(at / "app/loads.csv") << "mine";
    checked(at / "app", "manifest.json: is there already");
  }
  publish_first(at / "other");
  auto json = nlohmann::ordered_json::parse(bytes(at / "other/manifest.json"));
  json["program"]["name"] = "another";
  std::ofstream(at / "other/manifest.json") << json.dump(2) << '\n';
  checked(at / "other", "manifest.json: is there already");
  publish_first(at / "changed");
  std::ofstream(at / "changed/shaft/zones.csv") << "first, and a note";
  checked(at / "changed", "changed/shaft/zones.csv: is there already, and no manifest.json");
  publish_first(at / "unlisted");
  std::ofstream(at / "unlisted/shaft/fatigue.csv") << "mine";
  checked(at / "unlisted", "unlisted/shaft/fatigue.csv: is there already, and no manifest.json");
  publish_first(at / "kept");
  std::ofstream(at / "kept/shaft/unit_responses.h5") << "mine";
  checked(at / "kept", "kept/shaft/unit_responses.h5: is there already");
}

// What appears while a command works is looked at again before anything gets its place.
TEST(StagedResults, LookAgainWhenTheyTakeTheirPlaces) {
  const Directory at;
  publish_first(at.path);
  StagedResults staged(at.path, run_names({"shaft"}));
  write_second(staged);
  std::ofstream(at / "shaft/mesh.msh") << "mine";
  const auto before = visible_files(at.path);
  EXPECT_THROW(staged.publish(), OptionError);
  EXPECT_EQ(visible_files(at.path), before);
}

// Results of two commands lie beside each other under one manifest.
TEST(StagedResults, OfSeveralCommandsShareADirectory) {
  const Directory at;
  const auto publish_ports = [&](const std::string& text) {
    StagedResults staged(at.path, names_of({"shaft/ports.vtu", "shaft/ports.png"}));
    write_text_file(staged.folder() / "shaft/ports.vtu", text);
    staged.publish();
  };
  publish_ports("a");
  publish_first(at.path);
  publish_ports("b");
  publish_second(at.path);
  EXPECT_EQ(bytes(at / "shaft/ports.vtu"), "b");
  EXPECT_EQ(bytes(at / "shaft/zones.csv"), "second");
  EXPECT_FALSE(check_manifest(at.path).is_mixed());
  EXPECT_EQ(read_manifest(OpenDirectory::at(at.path))->count("shaft/ports.vtu"), 1u);
}

}  // namespace
