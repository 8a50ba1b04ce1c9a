#include "pipelines/base/common/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

namespace pipelines {
namespace {

constexpr int bar_width = 30;

/// Who cannot be told goes without: fmt::print would throw where stderr is closed or its disk full, and
/// stages end in destructors.
void tell(const std::string& text) {
  std::fputs(text.c_str(), stderr);
}

/// The present stage, when it all began, and how long it is expected to take.
struct Bar {
  std::string stage;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double expected_s = 0;

  void draw(double share_of_stage, const std::string& step) const {
    const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - start;
    const double share = expected_s > 0 ? so_far.count() / expected_s : share_of_stage;
    const int full = int(std::clamp(share, 0.0, 1.0) * bar_width);
    const auto left =
        expected_s > so_far.count() ? fmt::format(", about {:.0f} s left", expected_s - so_far.count()) : "";
    // Erase to the end of the line, so that a longer text before leaves nothing behind.
    tell(fmt::format("\r  [{:#<{}}{:.<{}}] {:.0f} s{}  {} {}\x1b[K", "", full, "", bar_width - full,
                     so_far.count(), left, stage, step));
    std::fflush(stderr);
  }
};

}  // namespace

ProgressListener progress_on_stderr(Verbosity verbosity, double expected_s) {
  ProgressListener listener;
  if (verbosity == Verbosity::quiet) return listener;
  const bool terminal = has_progress_bar(verbosity), verbose = verbosity == Verbosity::verbose;
  const auto bar = std::make_shared<Bar>();
  bar->expected_s = expected_s;
  listener.begin = [=](const std::string& name) {
    bar->stage = name;
    if (terminal) bar->draw(0, "");
  };
  listener.advance = [=](double share, const std::string& step) {
    if (terminal)
      bar->draw(share, step);
    else if (verbose)
      tell(fmt::format("  {}: {}\n", bar->stage, step));
  };
  listener.end = [=](const StageCost& cost) {
    if (terminal) tell("\r\x1b[K");
    if (verbose) tell(fmt::format("  {:<12}{:8.2f} s\n", cost.stage, cost.seconds));
    std::fflush(stderr);
  };
  listener.note = [=](const std::string& what) {
    if (terminal) tell("\r\x1b[K");
    tell("  " + what + "\n");
    std::fflush(stderr);
  };
  return listener;
}

bool has_progress_bar(Verbosity verbosity) {
  return verbosity != Verbosity::quiet && isatty(STDERR_FILENO) == 1;
}

}  // namespace pipelines
