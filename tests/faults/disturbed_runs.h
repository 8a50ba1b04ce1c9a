/// Runs that something goes wrong with, in a directory that has the results of an earlier one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/cases/program/program.h"

namespace faults {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

/// How many disturbances a test tries: by default what it says, else what MILLSTRESS_FAULTS says; 0 there
/// means every possible one.
long asked_for(long by_default, long all);

/// A short bar between two bearings, pulled in the middle by so many kN; each pull has a length of its own,
/// hence a mesh and unit responses of its own. A second and a half as a solid, half of one as a beam.
std::string short_bar(int pull_kN);

/// Everything below a directory, hidden names too, without timing (cases::contents).
Files results_in(const fs::path& directory);

class DisturbedRuns : public testing::Test {
protected:
  /// Makes the earlier results and, elsewhere, those that an undisturbed run of the next scene has.
  void prepare(const std::string& model);

  /// Puts the directory `out` back to the earlier results.
  void restore() const;

  /// Runs the next scene into `out`.
  /// @param before  commands of the shell that set the stage
  cases::Outcome run_next(const std::string& before = "true") const;

  /// The shell's commands that make the disk below `below_` fail (failing_disk.cc).
  std::string failing(const std::string& kind, long at) const;

  /// The operations on the disk that an undisturbed run takes, from the earlier results on: of each its
  /// letter (failing_disk.cc).
  std::string operations() const;

  /// The earlier results are whole, or the next ones; a report can be made of them; and the next run ends
  /// with what an undisturbed one has, nothing more and nothing less.
  /// @return whether the next results were there at once
  bool expect_nothing_lost(const std::string& what) const;

  results_test::Directory directory_;
  std::string launcher_;  ///< cases::Start
  /// Whether the same run gives the same bytes. MUMPS, the direct solver on several ranks, does not promise
  /// it: then results are the same that have the same names and the same governing stress to 1e-9.
  bool bits_repeat_ = true;
  std::string arguments_;
  std::string below_ = "out";  ///< the folder whose disk fails
  Files earlier_, next_;

private:
  bool same(const Files& found, const Files& wanted) const;
  cases::Outcome run(const std::string& arguments, const std::string& before = "true") const;
};

}  // namespace faults
