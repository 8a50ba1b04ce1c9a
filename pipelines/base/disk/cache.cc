#include "pipelines/base/disk/cache.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <string_view>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/staging.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

constexpr const char* limit_variable = "MILLSTRESS_CACHE_LIMIT";
constexpr double default_limit_GB = 5;

/// The specification of the cache directory has relative paths ignored.
fs::path absolute_path_of(const char* variable) {
  const char* text = std::getenv(variable);
  const fs::path path = text == nullptr ? "" : text;
  return path.is_absolute() ? path : fs::path();
}

bool is_cached_name(const std::string& name) {
  static const std::regex form("[0-9a-f]{32}\\.h5");
  return std::regex_match(name, form);
}

}  // namespace

fs::path cache_directory() {
  if (const auto given = absolute_path_of("XDG_CACHE_HOME"); !given.empty()) return given / "millstress";
  if (const auto home = absolute_path_of("HOME"); !home.empty()) return home / ".cache/millstress";
  throw FileError("no cache: neither XDG_CACHE_HOME nor HOME names an absolute directory; set one of them");
}

fs::path cached_file(const std::string& key_hash) {
  return cache_directory() / (key_hash + ".h5");
}

void mark_used(const fs::path& file) {
  const timespec times[2] = {{0, UTIME_NOW}, {0, UTIME_OMIT}};
  utimensat(AT_FDCWD, file.c_str(), times, 0);
}

std::uintmax_t cache_limit() {
  const char* text = std::getenv(limit_variable);
  if (text == nullptr || *text == '\0') return std::uintmax_t(default_limit_GB * 1e9);
  const std::string_view given = text;
  double gigabytes = 0;
  const auto read = std::from_chars(given.data(), given.data() + given.size(), gigabytes);
  if (read.ec != std::errc() || read.ptr != given.data() + given.size() ||
      !(gigabytes >= 0 && gigabytes < 1e9))
    throw FileError(std::string(limit_variable) + " = " + text +
                    ": is no size of the cache in GB; give a number such as 5, or 0 for none");
  return std::uintmax_t(gigabytes * 1e9);
}

std::vector<CachedFile> cached_files() {
  std::vector<CachedFile> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(cache_directory(), none)) {
    struct stat status;
    if (!is_cached_name(entry.path().filename().string()) || lstat(entry.path().c_str(), &status) != 0 ||
        !S_ISREG(status.st_mode))
      continue;
    files.push_back({entry.path(), std::uintmax_t(status.st_size),
                     std::int64_t(status.st_atim.tv_sec) * 1'000'000'000 + status.st_atim.tv_nsec});
  }
  std::sort(files.begin(), files.end(),
            [](const CachedFile& a, const CachedFile& b) { return a.used_ns < b.used_ns; });
  return files;
}

void keep_cache_within(std::uintmax_t limit) {
  const auto files = cached_files();
  std::uintmax_t bytes = 0;
  for (const auto& file : files) bytes += file.bytes;
  for (const auto& file : files) {
    if (bytes <= limit) break;
    std::error_code gone;
    fs::remove(file.file, gone);
    bytes -= file.bytes;
  }
}

}  // namespace pipelines
