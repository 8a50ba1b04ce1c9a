#include "fem/base/common/memory.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef MILLSTRESS_JEMALLOC
#include <jemalloc/jemalloc.h>
#elif defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace fem {
namespace {

namespace fs = std::filesystem;
constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number behind a key of a file of lines "key number ..."; `otherwise` without it.
double number_of(const fs::path& path, const std::string& wanted, double otherwise) {
  std::ifstream file(path);
  std::string key;
  for (double number = 0; file >> key; file.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
    if (key == wanted && file >> number) return number;
  return otherwise;
}

/// The number that is all of a file; `otherwise` if it holds none ("max").
double only_number(const fs::path& path, double otherwise) {
  double number = 0;
  return std::ifstream(path) >> number ? number : otherwise;
}

struct Limit {
  double bytes = unlimited;  ///< that the process may have
  double used = 0;           ///< by it, or by its group
};

Limit limit_on(int resource, const std::string& used_key) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  return {static_cast<double>(limit.rlim_cur), 1024 * number_of("/proc/self/status", used_key, 0)};
}

/// On addresses and on data.
std::array<Limit, 2> limits_of_process() {
  return {limit_on(RLIMIT_AS, "VmSize:"), limit_on(RLIMIT_DATA, "VmData:")};
}

/// The tightest of the process' own limits and of its control group's with all above that.
template <class Measure>
double smallest_over_limits(const Measure& measure) {
  double smallest = unlimited;
  for (const auto& limit : limits_of_process()) smallest = std::min(smallest, measure(limit));
  const fs::path root = "/sys/fs/cgroup";
  std::string line, group;
  for (std::ifstream file("/proc/self/cgroup"); std::getline(file, line);)
    if (line.rfind("0::/", 0) == 0) group = line.substr(4);
  for (fs::path path = group;; path = path.parent_path()) {
    const fs::path here = path.empty() ? root : root / path;
    const double given_back = number_of(here / "memory.stat", "inactive_file", 0);
    smallest = std::min(smallest, measure({only_number(here / "memory.max", unlimited),
                                           only_number(here / "memory.current", 0) - given_back}));
    if (path.empty()) return smallest;
  }
}

}  // namespace

double limit_of_process() {
  const auto limits = limits_of_process();
  return std::min(limits[0].bytes, limits[1].bytes);
}

bool has_room_for(std::size_t bytes) {
  void* const room = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) return false;
  munmap(room, bytes);
  return true;
}

double physical_memory() {
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return std::min(machine, smallest_over_limits([](const Limit& limit) { return limit.bytes; }));
}

double free_memory() {
  const double machine = number_of("/proc/meminfo", "MemAvailable:", physical_memory() / 1024) * 1024;
  const auto left = [](const Limit& limit) { return std::max(0.0, limit.bytes - limit.used); };
  return std::min(machine, smallest_over_limits(left));
}

void make_room(double bytes) {
  if (bytes > free_memory()) release_free_memory();
}

void release_free_memory() {
#ifdef MILLSTRESS_JEMALLOC
  static const std::string purge = "arena." + std::to_string(MALLCTL_ARENAS_ALL) + ".purge";
  mallctl(purge.c_str(), nullptr, nullptr, nullptr, 0);
#elif defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace fem

#ifdef MILLSTRESS_JEMALLOC
// Read by jemalloc as the program starts. A factor of gigabytes touches each of its pages once: huge ones
// save a quarter of the seconds of a solve where pages are slow to get, as in virtual machines. Large arrays
// too are kept for a minute after their end, for those of the next mesh. What goes back goes wholly, so that
// a limit on addresses (ulimit -v) counts what is in use.
extern "C" {
extern const char* malloc_conf;
const char* malloc_conf = "thp:always,retain:false,oversize_threshold:0,dirty_decay_ms:60000";
}
#endif
