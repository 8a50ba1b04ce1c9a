#include "pipelines/files/atomic_file.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>

#include "pipelines/common/errors.h"

namespace pipelines {
namespace {

const std::string suffix = ".partial";

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof(name) - 1) == 0 ? name : "localhost";
}

/// ".<target>.<host>.<process>-<count>.partial": hidden, and unique among threads, processes and machines.
std::string common_start(const std::filesystem::path& target) {
  return "." + target.filename().string() + "." + host_name() + ".";
}

bool is_left_behind(const std::string& name, const std::string& start) {
  if (name.size() <= start.size() + suffix.size() || name.compare(0, start.size(), start) != 0 ||
      name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0)
    return false;
  const long process = std::strtol(name.c_str() + start.size(), nullptr, 10);
  return process > 0 && kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

void remove_left_behind(const std::filesystem::path& directory, const std::string& start) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
    if (is_left_behind(entry.path().filename().string(), start))
      std::filesystem::remove(entry.path(), ignored);
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
  static std::atomic<unsigned> count{0};
  const auto directory = target_.has_parent_path() ? target_.parent_path() : std::filesystem::path(".");
  std::filesystem::create_directories(directory);
  const std::string start = common_start(target_);
  remove_left_behind(directory, start);
  temporary_ = directory / (start + std::to_string(getpid()) + "-" + std::to_string(count++) + suffix);
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  std::filesystem::rename(temporary_, target_);
  committed_ = true;
}

void write_text_file(const std::filesystem::path& path, std::string_view content) {
  AtomicFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw FileError(path.string() + ": cannot be written; check the directory and the free space");
  file.commit();
}

}  // namespace pipelines
