#include "fem/base/common/deadline.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>

namespace fem {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
std::atomic<double> deadline_s{never};  // on the clock of now_s
std::atomic<double> pace{1};            // taken over predicted seconds

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Deadline::Deadline(double seconds) : before_(deadline_s) {
  deadline_s = std::min(before_, now_s() + seconds);
}

Deadline::~Deadline() {
  deadline_s = before_;
}

double seconds_to_deadline() {
  const double end_s = deadline_s;
  return end_s == never ? never : end_s - now_s();
}

void require_time(double seconds) {
  const double end_s = deadline_s;
  if (end_s != never && now_s() + seconds >= end_s) throw OutOfTime("the time is up");
}

double at_present_pace(double predicted_s) {
  return pace * predicted_s;
}

void note_pace(double predicted_s, double taken_s) {
  constexpr double least_s = 0.1;
  if (predicted_s > 0 && taken_s >= least_s) pace = taken_s / predicted_s;
}

}  // namespace fem
