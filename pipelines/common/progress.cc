#include "pipelines/common/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

namespace pipelines {
namespace {

constexpr int bar_width = 30;

/// Who cannot be told goes without: fmt::print would throw where stderr is closed or its disk full, and stages
/// end in destructors.
void tell(const std::string& text) {
  std::fputs(text.c_str(), stderr);
}

void draw_bar(const std::string& stage, double share, const std::string& step) {
  const int full = int(share * bar_width);
  // Erase to the end of the line, so that a longer text before leaves nothing behind.
  tell(fmt::format("\r  {:<12}[{:#<{}}{:.<{}}] {:3.0f} %  {}\x1b[K", stage, "", full, "", bar_width - full,
                   share * 100, step));
  std::fflush(stderr);
}

}  // namespace

ProgressListener progress_on_stderr(Verbosity verbosity) {
  ProgressListener listener;
  if (verbosity == Verbosity::quiet) return listener;
  const bool terminal = isatty(STDERR_FILENO) == 1, verbose = verbosity == Verbosity::verbose;
  const auto stage = std::make_shared<std::string>();
  listener.begin = [=](const std::string& name) {
    *stage = name;
    if (terminal) draw_bar(name, 0, "");
  };
  listener.advance = [=](double share, const std::string& step) {
    if (terminal)
      draw_bar(*stage, share, step);
    else if (verbose)
      tell(fmt::format("  {}: {}\n", *stage, step));
  };
  listener.end = [=](const StageCost& cost) {
    if (terminal) tell("\r\x1b[K");
    if (!terminal || verbose) tell(fmt::format("  {:<12}{:8.2f} s\n", cost.stage, cost.seconds));
    std::fflush(stderr);
  };
  return listener;
}

}  // namespace pipelines
