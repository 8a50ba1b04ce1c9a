// Bytes of files that change between two runs: of what is kept for later runs, and of results.
// MILLSTRESS_FAULTS says how many changes are tried per file.
#include <cstdio>
#include <random>

#include "tests/faults/disturbed_runs.h"

namespace {

using faults::asked_for;
using Json = nlohmann::json;

class Flips : public faults::DisturbedRuns {
protected:
  /// Changes one byte.
  /// @return where, for the message of a test
  std::string change(const faults::fs::path& file) {
    auto text = results_test::bytes(file);
    const auto at = random_() % text.size();
    const char old = text[at];
    text[at] = char(old ^ char(1 + random_() % 255));
    cases::write(file, text);
    return file.filename().string() + ", byte " + std::to_string(at);
  }

  std::mt19937_64 random_{24};
};

/// A summary without what a warning adds.
Json without_warnings(const std::string& text) {
  auto json = Json::parse(text);
  json.erase("warnings");
  return json;
}

/// That the results are the wanted ones but for the warning that something was damaged.
void expect_same_figures(const faults::Files& found, const faults::Files& wanted, const std::string& what) {
  for (const auto& [name, bytes] : wanted) {
    if (name == "run.json") continue;  // results that tell of damage are not those of the same run later
    ASSERT_EQ(found.count(name), 1u) << what << ": " << name;
    if (name == "summary.json") {
      EXPECT_EQ(without_warnings(found.at(name)), without_warnings(bytes)) << what;
      continue;
    }
    const bool has_warning =
        name == "report.html" || name == "report.data" || name == "loads.h5" || name == "manifest.json";
    EXPECT_TRUE(has_warning || found.at(name) == bytes) << what << ": " << name;
  }
}

// Of 32 whole runs on kept responses with one byte changed, 11 had other results, one of them 235 MPa for 18.
TEST_F(Flips, InWhatIsKeptChangeNoResult) {
  prepare("solid");
  ASSERT_EQ(run_next().exit_code, 0);
  const auto responses = cases::cached_responses(directory_.path, "out");
  const long n = asked_for(1, 100);
  long n_told = 0;
  for (long i = 0; i < n && !HasFailure(); ++i) {
    const auto what = change(responses);
    faults::fs::remove(directory_ / "out/run.json");  // else nothing is computed, and nothing kept is read
    const auto again = run_next();
    EXPECT_EQ(again.exit_code, 0) << what << again.err;
    EXPECT_EQ(std::count(again.err.begin(), again.err.end(), '\n'), 1) << what << again.err;
    n_told += again.err.find("is damaged") != std::string::npos;
    expect_same_figures(faults::results_in(directory_ / "out"), next_, what);
  }
  std::printf("%ld changes of kept responses, told %ld times\n", n, n_told);
}

// A changed, cut or missing result is not reported as if it were the run's.
TEST_F(Flips, InResultsAreSeenByTheReport) {
  prepare("beam");
  long n_refused = 0, n = 0;
  for (const auto& [name, bytes] : earlier_) {
    if (name == "report.html") continue;  // is made from the others
    for (long i = 0; i < asked_for(1, 20) && !HasFailure(); ++i) {
      restore();
      const auto file = directory_ / "out" / name;
      std::string what = name;
      if (i == 1)
        faults::fs::resize_file(file, faults::fs::file_size(file) / 2);
      else
        what = change(file);
      const auto page = results_test::bytes(directory_ / "out/report.html");
      const auto outcome = cases::millstress(directory_.path, "report out");
      EXPECT_EQ(outcome.exit_code, 2) << what << ": " << outcome.err;
      EXPECT_NE(outcome.err.find(name), std::string::npos) << what << ": " << outcome.err;
      EXPECT_TRUE(results_test::bytes(directory_ / "out/report.html") == page) << what;
      ++n, n_refused += outcome.exit_code == 2;
    }
  }
  std::printf("%ld changes of results, %ld refused\n", n, n_refused);
}

// On a disk with room for so many bytes the run is told so, or ends well; whatever the number.
TEST_F(Flips, ADiskThatIsFullAtAnySize) {
  prepare("solid");
  std::uintmax_t whole = 0;
  for (const auto& [name, bytes] : cases::contents(directory_ / "out")) whole += bytes.size();
  const long n = asked_for(2, 10);
  for (long i = 0; i < n && !HasFailure(); ++i) {
    restore();
    const auto room = long(double(whole) * double(i) / double(n));
    const auto outcome = run_next(failing("bytes", room));
    EXPECT_EQ(outcome.exit_code, 3) << room << outcome.err;
    expect_nothing_lost("room for " + std::to_string(room) + " bytes");
  }
}

TEST_F(Flips, AReadOnlyDiskIsTold) {
  prepare("beam");
  const auto outcome = run_next(failing("read_only", 0));
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;  // another -o helps
  EXPECT_NE(outcome.err.find("out"), std::string::npos) << outcome.err;
  EXPECT_FALSE(expect_nothing_lost("read-only"));
}

}  // namespace
