/// What this process takes: seconds and memory. Linux.
#pragma once

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

namespace measure {

inline double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of all threads: on a machine with other work nearer to the truth than the wall's.
inline double cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Smallest CPU time of some calls.
template <typename Call>
double smallest_cpu_s(const Call& call, int n_calls) {
  double smallest = 1e300;
  for (int i = 0; i < n_calls; ++i) {
    const double start = cpu_s();
    call();
    smallest = std::min(smallest, cpu_s() - start);
  }
  return smallest;
}

/// A line of /proc/self/status in bytes: "VmHWM:", the largest resident memory since reset_peak(), or
/// "VmRSS:", that of now.
inline double memory_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(name, 0) == 0) return 1024 * std::atof(line.c_str() + name.size());
  return 0;
}

inline void reset_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace measure
