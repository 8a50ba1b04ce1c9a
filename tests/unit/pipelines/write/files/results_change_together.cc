#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/files/staged_results.h"
#include "tests/unit/pipelines/examples/staged_samples.h"

using namespace staged_samples;
using results_test::Directory;

namespace {

/// Changes of names until the process kills itself; negative: it does not.
int n_changes_left = -1;

bool disk_fails = false;

void count_change() {
  if (n_changes_left == 0) raise(SIGKILL);
  if (n_changes_left > 0) --n_changes_left;
}

}  // namespace

// In the place of the C library's.
extern "C" int renameat(int from_directory, const char* from, int to_directory, const char* to) noexcept {
  count_change();
  return int(syscall(SYS_renameat2, from_directory, from, to_directory, to, 0));
}

extern "C" int unlinkat(int directory, const char* file, int flags) noexcept {
  count_change();
  return int(syscall(SYS_unlinkat, directory, file, flags));
}

extern "C" int fsync(int) {
  errno = EIO;
  return disk_fails ? -1 : 0;
}

namespace {

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
    StagedResults staged(at.path, run_names({"shaft"}));
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
// soon as they are looked at through finish_exchange.
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
  EXPECT_GT(n_first, 1);
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

/// Results that a killed run has left complete, beside those of an earlier one.
void leave_complete(const fs::path& directory) {
  publish_first(directory);
  const pid_t child = fork();
  if (child == 0) {
    n_changes_left = 3;  // removals of the earlier ones begin
    publish_second(directory);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(fs::exists(directory / ".results.complete/shaft/zones.csv"));
}

std::string refusal_to_finish(const fs::path& directory) {
  try {
    finish_exchange(directory);
    return "";
  } catch (const OptionError& error) {
    return error.what();
  }
}

// A directory that somebody sent must not write outside itself, nor over what is not this program's.
TEST(StagedResults, FinishOnlyWhatIsWholeTheirs) {
  const Directory at;
  const std::string why = ": is not what a run of this program has left there complete";
  leave_complete(at / "good");
  EXPECT_EQ(refusal_to_finish(at / "good"), "");
  EXPECT_EQ(bytes(at / "good/shaft/mesh.msh"), "second");

  fs::create_directories(at / "victim");
  leave_complete(at / "linked_folder");
  const auto complete = at / "linked_folder/.results.complete";
  fs::create_symlink("../victim", at / "linked_folder/zz");
  fs::create_directories(complete / "zz");
  std::ofstream(complete / "zz/.bashrc") << "evil";
  expect_in(refusal_to_finish(at / "linked_folder"), ".results.complete/zz/.bashrc" + why);
  fs::remove(complete / "zz/.bashrc");
  std::ofstream(complete / "zz/evil.txt") << "evil";
  auto list = *read_manifest(OpenDirectory::at(complete));
  list["zz/evil.txt"] = {4, text_hash("evil")};
  write_list(complete / "manifest.json", list);
  expect_in(refusal_to_finish(at / "linked_folder"), "zz/evil.txt: lies in ");
  EXPECT_TRUE(fs::is_empty(at / "victim"));

  leave_complete(at / "link");
  fs::rename(at / "link/.results.complete", at / "elsewhere");
  fs::create_symlink("../elsewhere", at / "link/.results.complete");
  expect_in(refusal_to_finish(at / "link"), ".results.complete" + why);
  EXPECT_TRUE(fs::exists(at / "elsewhere/manifest.json"));

  leave_complete(at / "unlisted");
  std::ofstream(at / "unlisted/.results.complete/shaft/mesh.msh") << "not the run's";
  expect_in(refusal_to_finish(at / "unlisted"), "shaft/mesh.msh" + why);

  leave_complete(at / "without");
  fs::remove(at / "without/.results.complete/manifest.json");
  expect_in(refusal_to_finish(at / "without"), ".results.complete" + why);

  leave_complete(at / "target");
  std::ofstream(at / "target/shaft/zones.csv") << "mine";
  expect_in(refusal_to_finish(at / "target"), "target/shaft/zones.csv: is there already");
  EXPECT_EQ(bytes(at / "target/shaft/zones.csv"), "mine");
}

// D/shaft moved away and linked, then a scene without bodies; and a manifest that lists what lies behind a
// link.
TEST(StagedResults, RemoveNothingBehindALink) {
  const Directory at;
  publish_first(at / "results");
  fs::rename(at / "results/shaft", at / "archive");
  fs::create_symlink("../archive", at / "results/shaft");
  const auto before = visible_files(at / "archive");
  StagedResults staged(at / "results", run_names({}));
  write_text_file(staged.folder() / "loads.csv", "alone");
  staged.publish();
  EXPECT_EQ(visible_files(at / "archive"), before);
  EXPECT_EQ(bytes(at / "results/loads.csv"), "alone");
  expect_in(refusal(at / "results"), "results/shaft: is a symbolic link or no directory");
  EXPECT_EQ(visible_files(at / "archive"), before);

  fs::create_directories(at / "victim");
  std::ofstream(at / "victim/precious.txt") << "mine";
  publish_first(at / "sent");
  fs::create_symlink("../victim", at / "sent/zz");
  auto list = *read_manifest(OpenDirectory::at(at / "sent"));
  list["zz/precious.txt"] = {4, text_hash("mine")};
  write_list(at / "sent/manifest.json", list);
  publish_second(at / "sent");
  EXPECT_EQ(bytes(at / "victim/precious.txt"), "mine");
}

// A directory that is swapped while a command works gets nothing, and nothing goes through a link.
TEST(StagedResults, NothingGoesThroughADirectoryThatIsSwapped) {
  const Directory at;
  publish_first(at / "results");
  fs::create_directories(at / "victim");
  {
    StagedResults staged(at / "results", run_names({"shaft"}));
    write_text_file(staged.folder() / "summary.json", "{}");
    fs::rename(at / "results", at / "moved");
    fs::create_directory_symlink("victim", at / "results");
    write_second(staged);
    EXPECT_THROW(staged.publish(), OptionError);
  }
  EXPECT_TRUE(fs::is_empty(at / "victim"));
  EXPECT_EQ(bytes(at / "moved/loads.csv"), "first");

  publish_first(at / "inside");
  StagedResults staged(at / "inside", run_names({"shaft"}));
  write_second(staged);
  fs::rename(at / "inside/shaft", at / "shaft_moved");
  fs::create_directory_symlink("../victim", at / "inside/shaft");
  EXPECT_THROW(staged.publish(), OptionError);
  EXPECT_TRUE(fs::is_empty(at / "victim"));
  EXPECT_EQ(bytes(at / "inside/loads.csv"), "first");
}

// The list of what was written is what has to be there.
TEST(StagedResults, OfWhichOneIsMissingOrChangedAreNotPublished) {
  const Directory at;
  publish_first(at.path);
  const auto before = visible_files(at.path);
  const auto disturbed = [&](const std::function<void(const fs::path&)>& disturb) {
    StagedResults staged(at.path, run_names({"shaft"}));
    write_second(staged);
    disturb(staged.folder());
    EXPECT_THROW(staged.publish(), FileError);
    EXPECT_EQ(visible_files(at.path), before);
  };
  disturbed([](const fs::path& folder) { fs::remove(folder / "shaft/zones.csv"); });
  disturbed([](const fs::path& folder) { fs::resize_file(folder / "shaft/zones.csv", 3); });
  disturbed([](const fs::path& folder) { std::ofstream(folder / "shaft/more.csv") << "not written"; });
  disturbed([](const fs::path& folder) {
    fs::remove(folder / "loads.csv");
    fs::create_symlink("shaft/zones.csv", folder / "loads.csv");
  });
}

// Of a run that is alive nothing is removed, whatever number its process has in which namespace.
TEST(StagedResults, OfALivingRunStay) {
  const Directory at;
  publish_first(at.path);
  StagedResults first(at.path, run_names({"shaft"}));
  write_second(first);
  const pid_t child = fork();
  if (child == 0) {
    publish_first(at.path);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  first.publish();
  EXPECT_EQ(bytes(at / "shaft/mesh.msh"), "second");
  EXPECT_FALSE(check_manifest(at.path).is_mixed());
}

TEST(StagedResults, ThatAreRefusedLeaveNoDirectory) {
  const Directory at;
  { const StagedResults staged(at / "a/b/c", run_names({})); }
  EXPECT_FALSE(fs::exists(at / "a"));
}

}  // namespace
