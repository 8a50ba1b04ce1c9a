#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "pipelines/common/errors.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/files/content_hash.h"
#include "pipelines/files/replaceable.h"
#include "pipelines/result_files/manifest.h"
#include "pipelines/result_files/staged_results.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::bytes;
using results_test::Directory;
namespace fs = std::filesystem;

namespace {

/// Changes of names until the process kills itself; negative: it does not.
int n_changes_left = -1;

bool disk_fails = false;

void count_change() {
  if (n_changes_left == 0) raise(SIGKILL);
  if (n_changes_left > 0) --n_changes_left;
}

}  // namespace

// In the place of the C library's: std::filesystem calls these.
extern "C" int rename(const char* from, const char* to) noexcept {
  count_change();
  return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

extern "C" int remove(const char* file) noexcept {
  count_change();
  return unlinkat(AT_FDCWD, file, 0) == 0 ? 0 : unlinkat(AT_FDCWD, file, AT_REMOVEDIR);
}

extern "C" int fsync(int) {
  errno = EIO;
  return disk_fails ? -1 : 0;
}

namespace {

using Files = std::map<std::string, std::string>;

Files visible_files(const fs::path& directory) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (const auto name = fs::relative(entry.path(), directory).generic_string();
        entry.is_regular_file() && name[0] != '.')
      files[name] = bytes(entry.path());
  return files;
}

const std::string first_summary =
    R"({"program": {"name": "millstress"}, "bodies": {"shaft": {}, "drum": {}}, "run": "first"})";

/// Two bodies, one of them with a kept file.
void write_first(StagedResults& staged) {
  write_text_file(staged.folder() / "summary.json", first_summary);
  write_text_file(staged.folder() / "report.html", "first");
  write_text_file(staged.folder() / "loads.csv", "first");
  for (const char* name : {"shaft/zones.csv", "shaft/hot_spots.csv", "shaft/cycle_003.vtu", "drum/zones.csv",
                           "torsion/modes.csv"})
    write_text_file(staged.folder() / name, "first");
}

/// One body, and other files of it.
void write_second(StagedResults& staged) {
  write_text_file(staged.folder() / "summary.json",
                  R"({"program": {"name": "millstress"}, "bodies": {"shaft": {}}, "run": "second"})");
  write_text_file(staged.folder() / "report.html", "second");
  write_text_file(staged.folder() / "loads.csv", "second");
  for (const char* name : {"shaft/zones.csv", "shaft/mesh.msh"})
    write_text_file(staged.folder() / name, "second");
}

void publish_first(const fs::path& directory) {
  fs::create_directories(directory / "shaft");
  fs::create_directories(directory / "drum");
  std::ofstream(directory / "shaft/unit_responses.h5") << "kept";
  std::ofstream(directory / "drum/unit_responses.h5") << "kept";
  StagedResults staged(directory, {"shaft", "drum"});
  write_first(staged);
  staged.publish();
  std::ofstream(directory / "shaft/notes.txt") << "mine";
}

void publish_second(const fs::path& directory) {
  StagedResults staged(directory, {"shaft"});
  write_second(staged);
  staged.publish();
}

TEST(StagedResults, TakeTheirPlacesAndRemoveTheEarlierOnes) {
  const Directory at;
  publish_first(at.path);
  EXPECT_FALSE(check_manifest(at.path).is_mixed());
  EXPECT_EQ(bytes(at / "shaft/zones.csv"), "first");
  publish_second(at.path);
  auto files = visible_files(at.path);
  EXPECT_EQ(files.erase(manifest_name), 1u);
  EXPECT_EQ(files.erase("summary.json"), 1u);
  EXPECT_EQ(files, (Files{{"report.html", "second"},
                          {"loads.csv", "second"},
                          {"shaft/mesh.msh", "second"},
                          {"shaft/zones.csv", "second"},
                          {"shaft/unit_responses.h5", "kept"},
                          {"shaft/notes.txt", "mine"}}));
  EXPECT_FALSE(fs::exists(at / "drum"));
  EXPECT_FALSE(fs::exists(at / "torsion"));
  EXPECT_FALSE(check_manifest(at.path).is_mixed());
}

TEST(StagedResults, WithoutPublishingNothingChanges) {
  const Directory at;
  publish_first(at.path);
  const auto before = visible_files(at.path);
  {
    StagedResults staged(at.path, {"shaft"});
    write_second(staged);
  }
  EXPECT_EQ(visible_files(at.path), before);
  EXPECT_FALSE(check_manifest(at.path).is_mixed());
}

// What does not reach the disk is not published.
TEST(StagedResults, ADiskThatFailsIsTold) {
  const Directory at;
  publish_first(at.path);
  const auto before = visible_files(at.path);
  disk_fails = true;
  EXPECT_THROW(publish_second(at.path), FileError);
  disk_fails = false;
  EXPECT_EQ(visible_files(at.path), before);
  EXPECT_FALSE(fs::exists(at / ".results.complete"));
}

// A kill before every single change of a name: then the earlier results are whole, or the new ones are as
// soon as they are looked at through finish_exchange. The kept responses of a body that goes may be gone.
TEST(StagedResults, AKillAtAnyChangeLeavesOneRun) {
  const Directory at;
  publish_first(at / "finished");
  const auto first = visible_files(at / "finished");
  publish_second(at / "finished");
  const auto second = visible_files(at / "finished");
  int n_first = 0, n_second = 0, n_seen_half_way = 0;
  for (int change = 0;; ++change) {
    const auto directory = at / std::to_string(change);
    publish_first(directory);
    const pid_t child = fork();
    if (child == 0) {
      n_changes_left = change;
      publish_second(directory);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    const bool mixed = check_manifest(directory).is_mixed();
    n_seen_half_way += mixed ? 1 : 0;
    if (const auto seen = visible_files(directory); seen != first && seen != second) {
      EXPECT_TRUE(mixed || !check_manifest(directory).missing.empty() ||
                  fs::exists(directory / ".results.complete"))
          << change;
    }
    finish_exchange(directory);
    const auto files = visible_files(directory);
    EXPECT_TRUE(files == first || files == second) << change;
    EXPECT_FALSE(check_manifest(directory).is_mixed()) << change;
    (files == first ? n_first : n_second) += 1;
    publish_second(directory);
    EXPECT_EQ(visible_files(directory), second) << change;
    if (WIFEXITED(status)) {
      EXPECT_EQ(WEXITSTATUS(status), 0);
      break;
    }
  }
  EXPECT_GT(n_first, 5);
  EXPECT_GT(n_second, 10);
  EXPECT_GT(n_seen_half_way, 3);
}

TEST(StagedResults, AnythingChangedOrMixedIsToldByName) {
  const Directory at;
  publish_first(at.path);
  std::ofstream(at / "shaft/zones.csv") << "FIRST";
  auto check = check_manifest(at.path);
  EXPECT_EQ(check.changed, std::vector<std::string>{"shaft/zones.csv"});
  EXPECT_EQ(check.text(at.path),
            at.path.string() + ": shaft/zones.csv is not as the run wrote it that left manifest.json");
  std::ofstream(at / "shaft/zones.csv") << "first";
  EXPECT_FALSE(check_manifest(at.path).is_mixed());
  fs::remove(at / "loads.csv");
  check = check_manifest(at.path);
  EXPECT_FALSE(check.is_mixed());
  EXPECT_EQ(check.missing, std::vector<std::string>{"loads.csv"});
  const auto manifest = bytes(at / manifest_name);
  for (std::size_t i = 0; i < manifest.size(); i += 7) {
    auto changed = manifest;
    changed[i] = char(changed[i] ^ 1);
    std::ofstream(at / manifest_name, std::ios::binary) << changed;
    // Blanks, and the program's version, mean nothing.
    const auto program = manifest.find("\"files\"");
    if (check_manifest(at.path).is_mixed() || i < program || manifest[i] == ' ' || manifest[i] == '\n')
      continue;
    ADD_FAILURE() << i << ' ' << manifest.substr(i, 20);
  }
}

// A list that leads out of the directory would let a damaged manifest remove what is not its own.
TEST(StagedResults, AManifestDoesNotReachOutOfItsDirectory) {
  const Directory at;
  std::ofstream(at / "mine.csv") << "mine";
  publish_first(at / "results");
  auto manifest = nlohmann::ordered_json::parse(bytes(at / "results/manifest.json"));
  manifest["files"]["../mine.csv"] = manifest["files"]["loads.csv"];
  manifest["checksum"] = text_hash(manifest["files"].dump());
  std::ofstream(at / "results/manifest.json") << manifest.dump();
  EXPECT_TRUE(check_manifest(at / "results").damaged);
  publish_second(at / "results");
  EXPECT_EQ(bytes(at / "mine.csv"), "mine");
}

TEST(StagedResults, RefuseWhatIsNotTheirs) {
  const auto refused = [](const fs::path& directory) -> std::string {
    try {
      publish_second(directory);
      return "";
    } catch (const OptionError& error) {
      return error.what();
    }
  };
  const Directory at;
  fs::create_directories(at / "foreign");
  std::ofstream(at / "foreign/loads.csv") << "mine";
  EXPECT_NE(refused(at / "foreign").find("foreign/loads.csv: is there already"), std::string::npos);
  EXPECT_EQ(visible_files(at / "foreign"), (Files{{"loads.csv", "mine"}}));
  EXPECT_EQ(std::distance(fs::directory_iterator(at / "foreign"), {}), 1);

  publish_first(at / "links");
  fs::rename(at / "links/shaft/zones.csv", at / "elsewhere.csv");
  fs::create_symlink(at / "elsewhere.csv", at / "links/shaft/zones.csv");
  EXPECT_NE(refused(at / "links").find("links/shaft/zones.csv: is a symbolic link"), std::string::npos);
  EXPECT_EQ(bytes(at / "elsewhere.csv"), "first");
  EXPECT_EQ(bytes(at / "links/loads.csv"), "first");

  publish_first(at / "inputs");
  note_input(at / "inputs/loads.csv");
  EXPECT_NE(refused(at / "inputs").find("inputs/loads.csv: is an input of this run"), std::string::npos);
  EXPECT_EQ(bytes(at / "inputs/loads.csv"), "first");

  // Directories of versions without a manifest have a summary.
  fs::create_directories(at / "older/shaft");
  std::ofstream(at / "older/summary.json") << first_summary;
  std::ofstream(at / "older/shaft/envelope_1.vtu") << "first";
  EXPECT_EQ(refused(at / "older"), "");
  EXPECT_FALSE(fs::exists(at / "older/shaft/envelope_1.vtu"));
}

}  // namespace
