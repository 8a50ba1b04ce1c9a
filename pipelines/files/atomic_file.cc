#include "pipelines/files/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "pipelines/common/errors.h"
#include "pipelines/files/replaceable.h"

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

/// Also of one that was killed and whose parent has not asked for it yet: Linux names its state Z, behind the
/// name in brackets.
bool is_gone(pid_t process) {
  if (kill(process, 0) != 0) return errno == ESRCH;
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto end = text.rfind(") ");
  return end != std::string::npos && text.compare(end, 3, ") Z") == 0;
}

/// Also what a library wrote beside a temporary name, with an ending of its own behind it.
bool is_left_behind(const std::string& name, const std::string& start) {
  if (name.compare(0, start.size(), start) != 0 || name.find(suffix, start.size()) == std::string::npos)
    return false;
  const long process = std::strtol(name.c_str() + start.size(), nullptr, 10);
  return process > 0 && is_gone(static_cast<pid_t>(process));
}

void remove_left_behind(const std::filesystem::path& directory, const std::string& start) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
    if (is_left_behind(entry.path().filename().string(), start))
      std::filesystem::remove_all(entry.path(), ignored);
}

std::filesystem::path directory_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

bool ends_with(const std::filesystem::path& file, std::string_view end) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  if (none || size < end.size()) return false;
  std::string text(end.size(), '\0');
  std::ifstream in(file, std::ios::binary);
  in.seekg(std::streamoff(size - end.size()));
  in.read(text.data(), std::streamsize(text.size()));
  return in && text == end;
}

}  // namespace

std::filesystem::path partial_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> count{0};
  const auto directory = directory_of(target);
  std::filesystem::create_directories(directory);
  const std::string start = common_start(target);
  remove_left_behind(directory, start);
  return directory / (start + std::to_string(getpid()) + "-" + std::to_string(count++) + suffix);
}

void remove_partial_names(const std::filesystem::path& directory) {
  std::error_code ignored;
  const std::string host = "." + host_name() + ".";
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
    const auto name = entry.path().filename().string();
    const auto at = name.rfind(host);
    if (at != std::string::npos && at > 0 && name[0] == '.' &&
        is_left_behind(name, name.substr(0, at + host.size())))
      std::filesystem::remove_all(entry.path(), ignored);
  }
}

void bring_to_disk(const std::filesystem::path& file_or_directory) {
  const int file = open(file_or_directory.c_str(), O_RDONLY | O_CLOEXEC);
  const bool failed = file < 0 || (fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS);
  const std::string why = failed ? std::generic_category().message(errno) : "";
  if (file >= 0) close(file);
  if (failed)
    throw FileError(file_or_directory.string() + ": cannot be brought to the disk: " + why +
                    "; check the directory and the free space");
}

AtomicFile::AtomicFile(std::filesystem::path target)
    : target_(std::move(target)), temporary_(partial_name(target_)) {}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit(std::string_view end) {
  require_replaceable(target_);
  if (!end.empty() && !ends_with(temporary_, end))
    throw FileError(target_.string() + ": cannot be written completely; check the free space");
  if (std::filesystem::exists(temporary_)) bring_to_disk(temporary_);
  std::filesystem::rename(temporary_, target_);
  committed_ = true;
  bring_to_disk(directory_of(target_));
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
