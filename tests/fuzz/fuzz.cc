/// Damages inputs by chance and looks how the program ends: README of tests, section Fuzz.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "tests/fuzz/batch.h"
#include "tests/fuzz/kinds/samples.h"
#include "tests/fuzz/self_test.h"

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string kind;
  int n_cases = 1000, single_case = -1;
  double minutes = 0;  ///< 0: no bound
  bool self_test = false;
  fuzz::Batch batch;
};

/// A directory of this process, removed at the end; in memory where there is one: the program waits for the
/// disk at every file that it writes.
struct Scratch {
  fs::path path;
  Scratch() {
    const fs::path memory = "/dev/shm";
    const bool is_there = ::access(memory.c_str(), W_OK) == 0;
    path =
        (is_there ? memory : fs::temp_directory_path()) / ("millstress_fuzz_" + std::to_string(::getpid()));
    fs::create_directories(path);
  }
  ~Scratch() {
    std::error_code none;
    fs::remove_all(path, none);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

class Draw {
public:
  Draw(const Options& options, const fuzz::Place& place) : options_(options), place_(place) {}

  /// A thousand of all kinds, or fewer of one, again and again: cases of a kind are numbered on.
  void run() {
    const auto start = std::chrono::steady_clock::now();
    const auto minutes = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / 60;
    };
    for (int left = options_.n_cases; left > 0;) {
      const int round = std::min(1000, left);
      for (const auto& kind : fuzz::kinds()) {
        if (options_.minutes > 0 && minutes() > options_.minutes) return;
        left -= run_share(kind, left, round);
      }
    }
  }

  /// @return the number of faults
  int print() const {
    std::printf("%-14s %8s %9s %8s %7s  %s\n", "kind", "cases", "accepted", "refused", "faults",
                "slowest, s of a core");
    fuzz::Tally all;
    for (const auto& kind : fuzz::kinds()) {
      const auto found = tallies_.find(kind.name);
      if (found == tallies_.end()) continue;
      print_row(kind.name, found->second);
      all.add(found->second);
    }
    if (tallies_.size() > 1) print_row("all", all);
    return all.n_faults;
  }

private:
  int run_share(const fuzz::Kind& kind, int left, int round) {
    const bool alone = !options_.kind.empty();
    if (alone && options_.kind != kind.name) return 0;
    auto batch = options_.batch;
    auto& tally = tallies_[kind.name];
    batch.first = tally.n_cases;
    batch.n_cases = alone ? std::min(left, 200) : std::max(1, kind.per_thousand * round / 1000);
    tally.add(fuzz::run_batch(kind, batch, place_));
    return batch.n_cases;
  }

  static void print_row(const std::string& name, const fuzz::Tally& tally) {
    std::printf("%-14s %8d %9d %8d %7d  %.2f (case %d)\n", name.c_str(), tally.n_cases, tally.n_accepted,
                tally.n_refused, tally.n_faults, tally.slowest_s, tally.slowest_case);
  }

  const Options& options_;
  const fuzz::Place& place_;
  std::map<std::string, fuzz::Tally> tallies_;
};

const fuzz::Kind& kind_named(const std::string& name) {
  for (const auto& kind : fuzz::kinds())
    if (kind.name == name) return kind;
  throw std::invalid_argument("no such kind: " + name);
}

int run(Options& options, const fs::path& program) {
  const Scratch scratch;
  if (options.self_test) {
    const fuzz::Samples none;
    options.batch.kept = scratch.path / "kept";
    return fuzz::faults_are_seen(options.batch, {scratch.path / "case", scratch.path, none, program, 1}) ? 0
                                                                                                         : 1;
  }
  const auto samples = fuzz::make_samples(scratch.path / "samples", program);
  fs::create_directories(scratch.path / "outside");
  const fuzz::Place place{scratch.path / "case", scratch.path / "outside", samples, program,
                          options.batch.seconds_of_core};
  if (options.single_case >= 0) {
    options.batch.first = options.single_case;
    options.batch.n_cases = 1;
    options.batch.talkative = true;
    return fuzz::run_batch(kind_named(options.kind), options.batch, place).n_faults > 0 ? 1 : 0;
  }
  Draw draw(options, place);
  draw.run();
  return draw.print() > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape): of the handler's own output
  CLI::App app{"Damages inputs by chance and looks how the program ends."};
  Options options;
  fs::path program = MILLSTRESS;
  options.batch.kept = "fuzz_faults";
  std::vector<std::string> names;
  for (const auto& kind : fuzz::kinds()) names.push_back(kind.name);
  auto* kind =
      app.add_option("--kind", options.kind, "cases of this kind alone")->check(CLI::IsMember(names));
  app.add_option("--cases", options.n_cases, "how many, about; in thousands")->check(CLI::PositiveNumber);
  app.add_option("--minutes", options.minutes, "none begins after these");
  app.add_option("--seed", options.batch.seed, "another seed, other cases");
  app.add_option("--case", options.single_case, "this one alone, as a fault names it")->needs(kind);
  app.add_option("--seconds", options.batch.seconds_of_core, "of a core, that a case may take");
  app.add_option("--keep", options.batch.kept, "directory for the files of cases that end badly");
  app.add_flag("--talk", options.batch.talkative, "say of every case what was done, and how it ended");
  app.add_flag("--self-test", options.self_test, "try whether faults are seen");
  CLI11_PARSE(app, argc, argv);
  try {
    options.batch.kept = fs::absolute(options.batch.kept);
    return run(options, program);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fuzz: %s\n", error.what());
    return 2;
  }
}
