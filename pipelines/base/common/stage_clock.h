/// What each stage of a run costs: seconds of wall time, and the process's largest memory up to its end.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace pipelines {

struct StageCost {
  std::string stage;
  double seconds = 0;
  double peak_gigabytes = 0;  ///< resident memory of the process, largest so far
};

/// Largest resident memory of this process so far, or since it was last forgotten [GB]; 0 where the system
/// does not say.
double peak_memory_gigabytes();

/// Lets the peak begin anew from what is resident now, where the system allows it (Linux).
void forget_peak_memory();

/// Seconds of all stages of that name together; 0 if there is none.
double seconds_of(const std::vector<StageCost>& costs, const std::string& stage);

/// Told what happens while it happens. Empty functions are not called.
struct ProgressListener {
  std::function<void(const std::string& stage)> begin;
  std::function<void(double share, const std::string& step)> advance;  ///< within the stage, 0 to 1
  std::function<void(const StageCost& cost)> end;
  std::function<void(const std::string& what)> note;  ///< something worth a line: a step of a search
};

/// Runs stages one after another and keeps their cost.
class StageClock {
public:
  explicit StageClock(ProgressListener listener = {}) : listener_(std::move(listener)) {}

  /// Runs one stage and returns what it returns.
  template <typename Work>
  auto run(const std::string& stage, Work&& work) {
    const Timer timer(*this, stage);
    return work();
  }

  void advance(double share, const std::string& step) const {
    if (listener_.advance) listener_.advance(share, step);
  }
  void note(const std::string& what) const {
    if (listener_.note) listener_.note(what);
  }
  const std::vector<StageCost>& costs() const noexcept { return costs_; }

private:
  /// Takes the time from construction to destruction, also when an exception ends the stage.
  class Timer {
  public:
    Timer(StageClock& clock, std::string stage);
    ~Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

  private:
    StageClock& clock_;
    std::string stage_;
    std::chrono::steady_clock::time_point start_;
  };

  ProgressListener listener_;
  std::vector<StageCost> costs_;
};

}  // namespace pipelines
