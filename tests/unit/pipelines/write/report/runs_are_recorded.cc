/// run.json: what a run that is asked for again is recognised by.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/cache.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/kept_file.h"
#include "pipelines/write/files/run_record.h"
#include "pipelines/write/files/staged_results.h"
#include "pipelines/write/report/html_report.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::bytes;
using results_test::Directory;
namespace fs = std::filesystem;

namespace {

const std::string summary_text =
    R"({"program": {"name": "millstress", "version": "1"}, "input": {"scene": "a.toml", "title": "a",
        "hash": "1", "machine": "load_table", "turns": 1, "instants_per_turn": 24}, "warnings": [],
        "verdict": {"judgement": "OK", "headline": "OK", "parts": {}}, "loads": {}, "bodies": {}})";

const RunRecord record{"key", {{"shaft", text_hash("responses")}}, {"no picture: why"}, "\n a table\n  b\n"};

void publish(const fs::path& directory, const RunRecord& content) {
  StagedResults staged(directory, run_names({"shaft"}));
  write_text_file(staged.folder() / "summary.json", summary_text);
  write_text_file(staged.folder() / "shaft/zones.csv", "zones");
  write_html_report(staged.folder(), directory / "accuracy");
  write_run_record(staged.folder(), content);
  staged.publish();
}

void keep(const fs::path& file, const std::string& key) {
  std::ofstream(file, std::ios::binary) << "kept";
  append_checksum(file, key);
}

bool is_there(const fs::path& directory, const std::string& key = "key") {
  return earlier_run(directory, {"shaft"}, key).has_value();
}

TEST(RunKey, EverythingThatMattersIsInIt) {
  Scene scene;
  scene.file = "folder/scene.toml";
  const RequestedAccuracy accuracy{0.02, 60};
  const auto folder = fs::absolute("folder");
  const std::vector<NotedInput> inputs{{folder / "scene.toml", "1"}, {folder / "loads.csv", "2"}};
  std::set<std::string> keys;
  const auto key = [&](const Scene& of, const RequestedAccuracy& wanted, int n_threads, int n_ranks,
                       const std::vector<NotedInput>& read) {
    return run_key(of, wanted, n_threads, n_ranks, read);
  };
  const auto first = key(scene, accuracy, 1, 1, inputs);
  EXPECT_EQ(first.size(), 32u);
  EXPECT_EQ(key(scene, accuracy, 1, 1, inputs), first);
  keys.insert(first);
  keys.insert(key(scene, accuracy, 2, 1, inputs));
  keys.insert(key(scene, accuracy, 1, 2, inputs));
  keys.insert(key(scene, {0.03, 60}, 1, 1, inputs));
  keys.insert(key(scene, {0.02, 50}, 1, 1, inputs));
  keys.insert(key(scene, {0, 0}, 1, 1, inputs));
  keys.insert(key(scene, {0, 0, true}, 1, 1, inputs));
  keys.insert(key(scene, accuracy, 1, 1, {inputs[0]}));
  keys.insert(key(scene, accuracy, 1, 1, {inputs[0], {folder / "loads.csv", "3"}}));
  keys.insert(key(scene, accuracy, 1, 1, {inputs[0], {folder / "other.csv", "2"}}));
  std::size_t n = 10;
  EXPECT_EQ(keys.size(), n);
  const std::vector<std::vector<std::string>> lists{{"a=1"}, {"a=1", "b=2"}, {"a=1\nb=2"}, {"a=1\n3 b=2"}};
  for (const auto& settings : lists) {
    auto set = scene;
    set.settings = settings;
    keys.insert(key(set, accuracy, 1, 1, inputs));
    EXPECT_EQ(keys.size(), ++n) << settings.front();
  }
  auto other = scene;
  other.method = Method::beam;
  keys.insert(key(other, accuracy, 1, 1, inputs));
  other = scene;
  other.file = "folder/other.toml";
  keys.insert(key(other, accuracy, 1, 1, inputs));
  EXPECT_EQ(keys.size(), n + 2);

  // What cannot be read again is not recognised again.
  EXPECT_EQ(key(scene, accuracy, 1, 1, {inputs[0], {folder / "pipe", ""}}), "");
}

TEST(RunRecord, ComesBackAsItWas) {
  const Directory at;
  EXPECT_FALSE(is_there(at / "nowhere"));
  EXPECT_FALSE(fs::exists(at / "nowhere"));
  publish(at.path, record);
  const auto earlier = earlier_run(at.path, {"shaft"}, "key");
  ASSERT_TRUE(earlier.has_value());
  EXPECT_EQ(earlier->record.warnings, record.warnings);
  EXPECT_EQ(earlier->record.table, record.table);
  EXPECT_EQ(earlier->summary, summary_text);
  EXPECT_FALSE(is_there(at.path, "another key"));
  EXPECT_FALSE(is_there(at.path, ""));
}

TEST(RunRecord, WithoutAKeyOrWithTextThatIsNoneItIsNotBelieved) {
  for (const auto& content : {RunRecord{"", {}, {}, "table\n"}, RunRecord{"key", {}, {}, "\xff\n"},
                              RunRecord{"key", {}, {"\xff"}, ""}}) {
    const Directory at;
    publish(at.path, content);
    EXPECT_FALSE(is_there(at.path));
    EXPECT_FALSE(is_there(at.path, ""));
  }
}

TEST(RunRecord, IsBelievedBesideItsOwnResultsAlone) {
  const Directory at;
  publish(at.path, record);
  const auto zones = at / "shaft/zones.csv", page = at / "report.html";
  write_text_file(zones, "zonez");
  EXPECT_FALSE(is_there(at.path)) << "a changed result";
  write_text_file(zones, "zones");
  EXPECT_TRUE(is_there(at.path));
  const auto text = bytes(page);
  EXPECT_NE(text.find(", 1 turn of 24 instants;"), std::string::npos) << text;
  write_text_file(page, text + " ");
  EXPECT_THROW(is_there(at.path), OptionError) << "a changed page, which a run would replace";
  write_text_file(page, text);
  write_text_file(at / "accuracy/shaft.txt", "a table");
  EXPECT_FALSE(is_there(at.path)) << "the run would show what accuracy has found";
  publish_html_report(at.path, at / "accuracy");
  EXPECT_TRUE(is_there(at.path));

  setenv("XDG_CACHE_HOME", (at / "cache").c_str(), 1);
  const auto kept = cached_file(text_hash("responses"));
  EXPECT_FALSE(earlier_run(at.path, {"shaft"}, "key", true)) << "unit responses are needed";
  fs::create_directories(kept.parent_path());
  keep(kept, "responses");
  EXPECT_TRUE(is_there(at.path));
  EXPECT_TRUE(earlier_run(at.path, {"shaft"}, "key", true));
  keep(kept, "of another run");
  EXPECT_FALSE(is_there(at.path)) << "unit responses of another run";
  write_text_file(kept, "no kept file");
  EXPECT_FALSE(is_there(at.path)) << "a damaged file, which a run would mend";
  fs::remove(kept);
  EXPECT_TRUE(is_there(at.path));

  fs::create_symlink("zones.csv", at / "shaft/mesh.msh");
  EXPECT_THROW(is_there(at.path), OptionError) << "a run would replace it";
}

// The record of a directory that was copied without its manifest says nothing of the files beside it.
TEST(RunRecord, NeedsTheManifest) {
  const Directory at;
  publish(at.path, record);
  fs::remove(at / "manifest.json");
  EXPECT_FALSE(is_there(at.path));
}

}  // namespace
