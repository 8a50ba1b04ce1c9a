/// Many cases of one kind in a process of their own, so that what ends a case ends neither the others nor the
/// count.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/fuzz/kinds/cases.h"

namespace fuzz {

struct Tally {
  int n_cases = 0, n_accepted = 0, n_refused = 0, n_faults = 0;
  double slowest_s = 0;  ///< of a core, children included
  int slowest_case = -1;

  void add(const Tally& other);
};

struct Batch {
  std::uint64_t seed = 20;
  int first = 0, n_cases = 0;
  double seconds_of_core = 10;  ///< that a case may take
  std::filesystem::path kept;   ///< what ends badly is copied to here, one directory for each case
  bool talkative = false;       ///< says of every case what was done, and how it ended
};

/// Runs cases first .. first + n_cases - 1 in `place`, and says on stderr what ends badly: a signal, a fault,
/// or more time than a case may take. The same seed, kind and number are the same case.
Tally run_batch(const Kind& kind, const Batch& batch, const Place& place);

}  // namespace fuzz
