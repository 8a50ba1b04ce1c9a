#include "pipelines/base/common/stage_clock.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>

namespace pipelines {

double peak_memory_gigabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key;) {
    double kilobytes = 0;
    if (key == "VmHWM:" && status >> kilobytes) return kilobytes * 1024 / 1e9;
  }
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? double(usage.ru_maxrss) * 1024 / 1e9 : 0.0;
}

double seconds_of(const std::vector<StageCost>& costs, const std::string& stage) {
  double sum = 0;
  for (const auto& cost : costs)
    if (cost.stage == stage) sum += cost.seconds;
  return sum;
}

void forget_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

StageClock::Timer::Timer(StageClock& clock, std::string stage)
    : clock_(clock), stage_(std::move(stage)), start_(std::chrono::steady_clock::now()) {
  if (clock_.listener_.begin) clock_.listener_.begin(stage_);
}

StageClock::Timer::~Timer() {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  // Stages of one name (writing, at several places) are one line of the account.
  auto entry = std::find_if(clock_.costs_.begin(), clock_.costs_.end(),
                            [&](const auto& cost) { return cost.stage == stage_; });
  if (entry == clock_.costs_.end()) entry = clock_.costs_.insert(entry, StageCost{stage_, 0, 0});
  entry->seconds += seconds;
  entry->peak_gigabytes = peak_memory_gigabytes();
  if (clock_.listener_.end) clock_.listener_.end(StageCost{stage_, seconds, entry->peak_gigabytes});
}

}  // namespace pipelines
