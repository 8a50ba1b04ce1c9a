// What lies beside results and is not this program's, or is swapped while it works: links, directories that
// somebody sent, and runs in other process namespaces.
#define XXH_INLINE_ALL
#include <sys/wait.h>
#include <unistd.h>
#include <xxhash.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "tests/faults/disturbed_runs.h"

namespace {

namespace fs = faults::fs;

std::string hash_of(const std::string& text) {
  const auto hash = XXH3_128bits(text.data(), text.size());
  char digits[33];
  std::snprintf(digits, sizeof digits, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return digits;
}

/// A manifest that lists one file, with every checksum as it has to be.
std::string manifest_of(const std::string& name, const std::string& text) {
  const nlohmann::ordered_json files{{name, {{"bytes", text.size()}, {"xxh3_128", hash_of(text)}}}};
  nlohmann::ordered_json json{{"program", {{"name", "millstress"}, {"version", "0"}}}, {"files", files}};
  json["checksum"] = hash_of(json.dump());
  return json.dump(2) + "\n";
}

class OthersFiles : public faults::DisturbedRuns {
protected:
  /// The same scene without its shaft.
  void write_loads_alone() const {
    auto text = faults::short_bar(2);
    const auto begin = text.find("[shaft]"), end = text.find("[results]");
    cases::write(directory_ / "alone.toml", text.erase(begin, end - begin));
  }

  void make_victim(const std::string& name, const std::string& text) const {
    fs::create_directories(directory_ / "victim");
    cases::write(directory_ / "victim" / name, text);
  }

  pid_t started(const cases::Start& start) const {
    const auto command = cases::shell_command(start);
    const pid_t process = fork();
    if (process != 0) return process;
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }

  /// Waits until a run has begun to write, and until a number of its files are there.
  bool wait_for_staging() const {
    for (int tries = 0; tries < 60000; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      for (const auto& entry : fs::directory_iterator(directory_ / "out"))
        if (entry.path().extension() == ".partial" && fs::exists(entry.path() / ".lock")) return true;
    }
    return false;
  }
};

// The shaft's folder lies on another disk, and a link leads there: a scene without bodies removes nothing.
TEST_F(OthersFiles, NothingBehindALinkIsRemoved) {
  prepare("beam");
  write_loads_alone();
  fs::rename(directory_ / "out/shaft", directory_ / "archive");
  fs::create_directory_symlink("../archive", directory_ / "out/shaft");
  const auto before = cases::contents(directory_ / "archive");
  ASSERT_GT(before.size(), 3u);
  const auto alone = cases::as_a_user(directory_.path, "run alone.toml --force -q -o out");
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(cases::contents(directory_ / "archive"), before);
  const auto refused = run_next();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("-o "
                             "out/shaft: is a symbolic link"),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(cases::contents(directory_ / "archive"), before);
}

// A directory that somebody sent, with results that wait to take their places outside it.
TEST_F(OthersFiles, ADirectoryThatWasSentWritesNothingOutside) {
  prepare("beam");
  make_victim("precious.txt", "mine");
  const auto before = cases::contents(directory_ / "victim");
  fs::create_directory_symlink("../victim", directory_ / "out/zz");
  const auto complete = directory_ / "out/.results.complete";
  const auto expect_untouched = [&](const std::string& what) {
    for (const std::string command :
         {"report out", "run next.toml --method beam --tolerance none --force -q -o out"}) {
      const auto outcome = cases::as_a_user(directory_.path, command);
      EXPECT_EQ(outcome.exit_code, 2) << what << command << outcome.err;
      EXPECT_NE(outcome.err.find("move it away"), std::string::npos) << what << command << outcome.err;
      EXPECT_EQ(cases::contents(directory_ / "victim"), before) << what << command;
    }
  };
  fs::create_directories(complete / "zz");
  cases::write(complete / "zz/.bashrc", "evil");
  expect_untouched("without a manifest: ");
  cases::write(complete / "manifest.json", manifest_of("zz/.bashrc", "evil"));
  expect_untouched("a hidden file: ");
  fs::rename(complete / "zz/.bashrc", complete / "zz/rc");
  cases::write(complete / "manifest.json", manifest_of("zz/rc", "evil"));
  expect_untouched("behind a link: ");
  fs::rename(complete, directory_ / "elsewhere");
  fs::create_directory_symlink("../elsewhere", complete);
  expect_untouched("a link itself: ");
  fs::remove(complete);

  // A manifest that lists what lies behind the link.
  cases::write(directory_ / "out/manifest.json", manifest_of("zz/precious.txt", "mine"));
  for (const auto& entry : fs::directory_iterator(directory_ / "out"))
    if (const auto name = entry.path().filename(); name != "manifest.json" && name != "zz")
      fs::remove_all(entry.path());
  EXPECT_EQ(run_next().exit_code, 0);
  EXPECT_EQ(cases::contents(directory_ / "victim"), before);
}

// The directory, or the body's folder, becomes a link while the run works.
TEST_F(OthersFiles, ADirectoryThatIsSwappedIsNotWrittenThrough) {
  prepare("solid");
  for (const std::string folder : {"out", "out/shaft"}) {
    restore();
    fs::remove_all(directory_ / "victim");
    fs::remove_all(directory_ / "moved");
    fs::create_directory(directory_ / "victim");
    const cases::Start start{directory_.path, arguments_ + "out", "true", "", "swap"};
    const pid_t process = started(start);
    ASSERT_TRUE(wait_for_staging());
    fs::rename(directory_ / folder, directory_ / "moved");
    fs::create_directory_symlink(directory_ / "victim", directory_ / folder);
    int status = 0;
    waitpid(process, &status, 0);
    const auto outcome = cases::outcome_of(start, status);
    EXPECT_EQ(outcome.exit_code, 2) << folder << outcome.err;
    EXPECT_TRUE(fs::is_empty(directory_ / "victim")) << folder;
    fs::remove(directory_ / folder);
    fs::rename(directory_ / "moved", directory_ / folder);
    EXPECT_FALSE(expect_nothing_lost("swapped " + folder));
  }
}

// Two runs in one directory that do not see each other's processes, as in two containers.
TEST_F(OthersFiles, RunsInTwoProcessNamespacesLeaveEachOtherAlone) {
  const std::string apart = "unshare --pid --fork --mount-proc";
  if (std::system((apart + " true > /dev/null 2>&1").c_str()) != 0)
    GTEST_SKIP() << "the system permits no process namespaces of one's own, as many containers: there are no "
                    "such two runs";
  prepare("solid");
  std::vector<cases::Start> starts;
  for (const char* name : {"1", "2", "3"}) {
    // Each process has a number that no process of the other namespace has.
    std::string others;
    for (std::size_t i = 0; i < 3 * starts.size(); ++i) others += "/bin/true; ";
    starts.push_back({directory_.path, arguments_ + "out", "true",
                      apart + " sh -c '" + others + "\"$@\"; exit $?' sh", name});
    auto& text = starts.back().arguments;
    if (starts.size() == 2) text.replace(text.find("next.toml"), 9, "earlier.toml");
  }
  for (long i = 0; i < faults::asked_for(1, 10) && !HasFailure(); ++i) {
    restore();
    std::vector<pid_t> processes;
    for (const auto& start : starts) {
      processes.push_back(started(start));
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
    for (std::size_t k = 0; k < starts.size(); ++k) {
      int status = 0;
      waitpid(processes[k], &status, 0);
      const auto outcome = cases::outcome_of(starts[k], status);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(outcome.err, "") << outcome.err;
    }
    expect_nothing_lost("three namespaces");
  }
}

}  // namespace
