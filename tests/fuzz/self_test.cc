#include "tests/fuzz/self_test.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "pipelines/base/common/errors.h"
#include "tests/fuzz/verdicts.h"

namespace fuzz {
namespace {

Kind throwing(const std::string& name, const std::function<void()>& action) {
  return {name, 0, [action](Mutator&, const Place&) {
            return judged("file.txt", [&] {
              action();
              return std::string();
            });
          }};
}

[[noreturn]] void run_on() {
  for (volatile unsigned i = 0;; i = i + 1) {
  }
}

std::vector<Kind> faulty_kinds() {
  return {throwing("crash", [] { std::raise(SIGSEGV); }),
          throwing("abort", [] { std::abort(); }),
          throwing("hang", [] { run_on(); }),
          throwing("out-of-range", [] { static_cast<void>(std::vector<int>().at(1)); }),
          throwing("exit", [] { std::_Exit(7); }),
          throwing("unnamed-file", [] { throw pipelines::FileError("cannot be read"); }),
          throwing("no-remedy",
                   [] {
                     throw pipelines::SceneError({{"file.txt", 0, 0, "key", "value", ""}});
                   }),
          {"left-over", 0, [](Mutator&, const Place& place) {
             write_bytes(place / ".half.partial", "half");
             return Verdict{true, fault_of_leftovers(place.directory)};
           }}};
}

std::vector<Kind> sound_kinds() {
  return {throwing("accepted", [] {}),
          throwing("refused", [] { throw pipelines::FileError("file.txt: is damaged; write it again"); })};
}

}  // namespace

bool faults_are_seen(Batch batch, const Place& place) {
  constexpr int n = 3;
  batch.first = 0;
  batch.n_cases = n;
  batch.seconds_of_core = 0.5;
  bool all_seen = true;
  const auto expect = [&](const Kind& kind, int n_faults) {
    const auto tally = run_batch(kind, batch, place);
    const bool seen = tally.n_cases == n && tally.n_faults == n_faults;
    std::printf("%-14s %s\n", kind.name.c_str(), seen ? "as it should be" : "NOT AS IT SHOULD BE");
    all_seen = all_seen && seen;
  };
  for (const auto& kind : faulty_kinds()) expect(kind, n);
  for (const auto& kind : sound_kinds()) expect(kind, 0);
  return all_seen;
}

}  // namespace fuzz
