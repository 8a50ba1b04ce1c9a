/// What the program says, and ends with, when a command throws.
#pragma once

#include <stdexcept>
#include <string>

namespace pipelines {

enum ExitCode {
  done = 0,
  scene_is_wrong = 2,
  mesh_or_solve_failed = 3,
  tolerance_not_met = 4,
  verdict_not_ok = 5
};

/// A tolerance or time limit that a run did not meet, or bounds that no point of an optimisation keeps; the
/// results are kept.
class ToleranceNotMet : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A machine whose verdict is NOT OK, where the run was asked to fail then; its results are kept.
class VerdictNotOk : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

struct Failure {
  ExitCode code = mesh_or_solve_failed;
  std::string message;  ///< whole lines without the last line's end
};

/// The exception that is being handled, as a failure; only inside a catch clause. An exception of no type
/// that means a user's mistake, a mesh or a solve that failed, is said to be an internal error.
Failure failure_in_flight();

}  // namespace pipelines
