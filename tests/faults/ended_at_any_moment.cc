// Runs that are ended from outside at moments drawn at random, and several at once in one directory.
// MILLSTRESS_FAULTS says how many moments.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include "tests/faults/disturbed_runs.h"

namespace {

using faults::asked_for;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void wait_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// A shell with a process group of its own, as a terminal gives it.
pid_t started(const cases::Start& start) {
  const auto command = cases::shell_command(start);
  const pid_t process = fork();
  if (process == 0) {
    setpgid(0, 0);
    signal(SIGINT, SIG_DFL);  // a test in the background inherits that it is ignored
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  setpgid(process, process);
  return process;
}

cases::Outcome ended(const cases::Start& start, pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return cases::outcome_of(start, status);
}

pid_t parent_of(pid_t process) {
  const auto text = results_test::bytes("/proc/" + std::to_string(process) + "/stat");
  const auto end = text.rfind(')');  // of the name, which may have any sign in it
  return end == std::string::npos ? 0 : std::atoi(text.c_str() + std::min(end + 3, text.size()));
}

/// A process that has ended and was not asked for has no command line any more.
bool is_running(pid_t process) {
  return !results_test::bytes("/proc/" + std::to_string(process) + "/cmdline").empty();
}

/// The processes of the program that a process has started, itself or through others.
std::vector<pid_t> ranks_below(pid_t start) {
  std::vector<pid_t> found;
  for (const auto& entry : cases::fs::directory_iterator("/proc")) {
    const pid_t process = std::atoi(entry.path().filename().c_str());
    if (process <= 0 || results_test::bytes(entry.path() / "cmdline").rfind(MILLSTRESS, 0) != 0) continue;
    for (pid_t above = parent_of(process); above > 1; above = parent_of(above))
      if (above == start) found.push_back(process);
  }
  return found;
}

class Moments : public faults::DisturbedRuns {
protected:
  cases::Start next_start(const std::string& name = "") const {
    return {directory_.path, arguments_ + "out", "true", launcher_, name};
  }

  /// Sends a signal to all of a run, at moments drawn between its start and its end.
  void end_at_random(int signal, long by_default) {
    const auto begin = std::chrono::steady_clock::now();
    restore();
    ended(next_start(), started(next_start()));
    const double run_s = seconds_since(begin);
    std::mt19937_64 random(20 + unsigned(signal));
    const long n = asked_for(by_default, 50);
    long n_next = 0, n_ended = 0;
    for (long i = 0; i < n && !HasFailure(); ++i) {
      restore();
      const auto start = next_start();
      const pid_t process = started(start);
      const double after_s = run_s * double(random() % 1000) / 1000;
      wait_s(after_s);
      kill(-process, signal);
      n_ended += ended(start, process).exit_code != 0;
      n_next += expect_nothing_lost("signal " + std::to_string(signal) + " after " + std::to_string(after_s) +
                                    " s");
    }
    std::printf("signal %d: %ld moments, %ld runs ended by it, %ld had their results in place\n", signal, n,
                n_ended, n_next);
    EXPECT_GT(n_ended, 0);
  }
};

TEST_F(Moments, AKillLosesNothing) {
  prepare("solid");
  end_at_random(SIGKILL, 2);
}

TEST_F(Moments, InterruptFromTheKeyboardLosesNothing) {
  prepare("solid");
  end_at_random(SIGINT, 2);
}

TEST_F(Moments, OneRankThatIsKilledEndsTheRunAndLosesNothing) {
  launcher_ = cases::two_ranks();
  bits_repeat_ = false;
  prepare("solid");
  std::mt19937_64 random(23);
  const long n = asked_for(1, 10);
  for (long i = 0; i < n && !HasFailure(); ++i) {
    restore();
    const auto start = next_start();
    const pid_t process = started(start);
    std::vector<pid_t> ranks;
    for (int tries = 0; tries < 500 && ranks.size() < 2; ++tries) {
      wait_s(0.01);
      ranks = ranks_below(process);
    }
    ASSERT_EQ(ranks.size(), 2u);
    wait_s(1e-3 * double(random() % 800));
    kill(ranks[i % 2 == 0 ? 1 : 0], SIGKILL);
    const auto begin = std::chrono::steady_clock::now();
    const auto outcome = ended(start, process);
    EXPECT_NE(outcome.exit_code, 0);
    // mpirun does not wait for all it has ended; a run beside a living one leaves its files alone.
    for (const auto rank : ranks)
      while (is_running(rank) && seconds_since(begin) < 20) wait_s(0.01);
    EXPECT_LT(seconds_since(begin), 20) << "the other rank waits for ever";
    expect_nothing_lost("a rank killed");
  }
}

// Two runs of one scene and two of another at once: the results are those of one run, whole.
TEST_F(Moments, FourRunsAtOnceLeaveOneWholeResult) {
  prepare("solid");
  std::vector<cases::Start> starts;
  for (const char* name : {"1", "2", "3", "4"}) {
    starts.push_back(next_start(name));
    auto& text = starts.back().arguments;
    if (starts.size() % 2 == 0) text.replace(text.find("next.toml"), 9, "earlier.toml");
  }
  const long n = asked_for(1, 10);
  for (long i = 0; i < n && !HasFailure(); ++i) {
    restore();
    std::vector<pid_t> processes;
    for (const auto& start : starts) processes.push_back(started(start));
    for (std::size_t k = 0; k < starts.size(); ++k) {
      const auto outcome = ended(starts[k], processes[k]);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    expect_nothing_lost("four at once");
  }
}

}  // namespace
