// The disk fails, or the process is killed, at any point of a run. SQLite's tests are the model: not only at
// random moments, but at each operation on the disk that the run takes. MILLSTRESS_FAULTS says how many of
// them are tried per kind of failure; 0 takes all.
#include <csignal>
#include <cstdio>

#include "tests/faults/disturbed_runs.h"

namespace {

using faults::asked_for;

struct Tally {
  long n = 0, next_results = 0, done = 0;
};

class Disk : public faults::DisturbedRuns {
protected:
  /// Disturbs a run at points spread over all its operations that the kind can disturb.
  void try_points(const std::string& kind, long by_default) {
    const auto points = points_of(kind);
    const long n_points = long(points.size()), n = asked_for(by_default, n_points);
    Tally tally;
    for (long i = 0; i < n; ++i) {
      // Few points lie closer towards the end, where results take their places.
      const double left = 1 - (2 * double(i) + 1) / (2 * double(n));
      try_one(kind, points.at(std::size_t(n == n_points ? i : long(double(n_points) * (1 - left * left)))),
              tally);
      if (HasFailure()) break;
    }
    std::printf(
        "%s: %ld of %ld operations that it can disturb tried; the run ended well %ld times, the next results "
        "were there %ld "
        "times\n",
        kind.c_str(), tally.n, n_points, tally.done, tally.next_results);
    EXPECT_GT(tally.n, tally.done) << "no disturbance was seen";
  }

  /// A write alone can be cut in half; at any other operation that is the same as `kill` or `from`. One
  /// removal that is to fail for want of space does not (failing_disk.cc).
  std::vector<long> points_of(const std::string& kind) const {
    std::vector<long> points;
    const auto letters = operations();
    for (std::size_t i = 0; i < letters.size(); ++i) {
      const bool is_disturbed = kind == "torn" || kind == "short" ? letters[i] == 'w'
                                : kind == "once"                  ? letters[i] != 'r'
                                                                  : true;
      if (is_disturbed) points.push_back(long(i));
    }
    return points;
  }

  /// A signal that asks the program to end, before an operation: it ends by that signal with one line, and
  /// what is visible is the earlier run's or the next one's at once, without the help of a command.
  void try_signal(const std::string& kind, const std::string& name, long by_default) {
    const auto points = points_of("kill");
    const long n_points = long(points.size()), n = asked_for(by_default, n_points);
    long n_next = 0;
    for (long i = 0; i < n && !HasFailure(); ++i) {
      const long at = points.at(std::size_t(n == n_points ? i : (n_points - 1) * (i + 1) / n));
      const std::string what = kind + " at " + std::to_string(at);
      restore();
      const auto outcome = run_next(failing(kind, at));
      EXPECT_TRUE(outcome.exit_code > 128 || outcome.exit_code == -1) << what << ": " << outcome.exit_code;
      const auto told = "millstress: ended by " + name +
                        "; results are those of before, or all new if they were complete\n";
      EXPECT_EQ(outcome.err.rfind(told, 0), 0u) << what << ": " << outcome.err;
      // The shell may add a line of its own, such as "Terminated".
      EXPECT_EQ(outcome.err.find("millstress", 1), std::string::npos) << what << ": " << outcome.err;
      faults::Files visible;
      for (auto& [file, bytes] : faults::results_in(directory_ / "out"))
        if (file[0] != '.' && file.find("/.") == std::string::npos) visible.emplace(file, std::move(bytes));
      EXPECT_TRUE(visible == earlier_ || visible == next_) << what << ": results of two runs are mixed";
      n_next += visible == next_;
      expect_nothing_lost(what);
    }
    std::printf("%s: %ld of %ld operations tried; the next results were there %ld times\n", name.c_str(), n,
                n_points, n_next);
  }

  void try_one(const std::string& kind, long at, Tally& tally) {
    const std::string what = kind + " at " + std::to_string(at);
    restore();
    const auto outcome = run_next(failing(kind, at));
    const bool killed = kind == "kill" || kind == "torn";
    ++tally.n;
    tally.done += outcome.exit_code == 0;
    if (killed) {
      EXPECT_TRUE(outcome.exit_code == 137 || outcome.exit_code == 0) << what << ": " << outcome.exit_code;
    } else {
      EXPECT_TRUE(outcome.exit_code == 3 || outcome.exit_code == 0)
          << what << ": " << outcome.exit_code << outcome.err;
      EXPECT_EQ(outcome.err.find("internal error"), std::string::npos) << what << ": " << outcome.err;
      EXPECT_LE(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << what << ": " << outcome.err;
      if (outcome.exit_code == 3) {
        EXPECT_NE(outcome.err.find("millstress: "), std::string::npos) << what;
      }
      // A disk that fails for good does not stand in the way of a run that says it is done.
      if (outcome.exit_code == 0) {
        EXPECT_EQ(difference_to_next(), "") << what;
      }
    }
    tally.next_results += expect_nothing_lost(what);
  }

  std::string difference_to_next() const {
    std::string names;
    const auto found = faults::results_in(directory_ / "out");
    for (const auto& [name, bytes] : next_)
      if (found.count(name) == 0 || found.at(name) != bytes) names += name + " ";
    return names;
  }
};

TEST_F(Disk, AKillBeforeAnyOperationOfABeamLosesNothing) {
  prepare("beam");
  try_points("kill", 4);
}

// While PETSc handled them, five of seven such signals ended as a segmentation fault.
TEST_F(Disk, ASignalWhileWritingEndsTheRunInOrder) {
  prepare("beam");
  // A test in the background inherits that they are ignored, and so would the program.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGHUP, SIG_DFL);
  try_signal("term", "SIGTERM", 4);
  try_signal("int", "SIGINT", 2);
  try_signal("hup", "SIGHUP", 2);
}

TEST_F(Disk, AWriteTornByAKillLosesNothing) {
  prepare("beam");
  try_points("torn", 2);
}

TEST_F(Disk, OneFailureAnywhereIsToldAndLosesNothing) {
  prepare("beam");
  try_points("once", 3);
}

TEST_F(Disk, FailureForGoodIsToldAndLosesNothing) {
  prepare("beam");
  try_points("from", 3);
}

TEST_F(Disk, AWriteCutInHalfIsToldAndLosesNothing) {
  prepare("beam");
  try_points("short", 2);
}

TEST_F(Disk, ASolidsFilesAreNoExceptionToKills) {
  prepare("solid");
  try_points("kill", 1);
}

TEST_F(Disk, ASolidsFilesAreNoExceptionToFailures) {
  prepare("solid");
  try_points("from", 1);
}

// The user's cache is none of the results: where it cannot be written, a run says so and has all of them.
TEST_F(Disk, ACacheThatFailsIsToldAndLosesNothing) {
  prepare("solid");
  below_ = "cache";
  const auto cache = directory_ / "cache/millstress";
  faults::fs::remove_all(cache);
  const long n_operations = long(operations().size()), n = asked_for(4, n_operations);
  ASSERT_GT(n_operations, 4);
  long n_told = 0;
  for (const char* kind : {"once", "from", "short"})
    for (long i = 0; i < n && !HasFailure(); ++i) {
      const auto what = std::string(kind) + ' ' + std::to_string(i);
      faults::fs::remove_all(cache);
      restore();
      const auto outcome = run_next(failing(kind, n_operations * i / n));
      EXPECT_EQ(outcome.exit_code, 0) << what << outcome.err;
      EXPECT_TRUE(outcome.err.empty() || outcome.err.find("are not kept for later runs") != std::string::npos)
          << what << outcome.err;
      n_told += outcome.err.empty() ? 0 : 1;
      EXPECT_EQ(difference_to_next(), "") << what;
      const auto again = run_next();
      EXPECT_EQ(again.err, "") << what;
    }
  EXPECT_GT(n_told, n) << "of " << 3 * n;
}

}  // namespace
