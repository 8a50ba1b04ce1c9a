#include "pipelines/base/disk/staging.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <regex>
#include <vector>

#include "pipelines/base/common/errors.h"

namespace pipelines {

const std::string lock_of_staging = ".lock";

namespace {

namespace fs = std::filesystem;

const std::string lock_of_directory = ".millstress.lock";

bool is_staging(const std::string& name) {
  static const std::regex form(R"(\.millstress-[0-9a-f]{16}\.partial)");
  return std::regex_match(name, form);
}

std::string new_name() {
  std::uint64_t number = 0;
  if (getrandom(&number, sizeof number, 0) != ssize_t(sizeof number))
    throw FileError("no random number is to be had from the system for the name of a temporary folder");
  char name[64];
  std::snprintf(name, sizeof name, ".millstress-%016llx.partial", static_cast<unsigned long long>(number));
  return name;
}

/// Locks the whole of an open file, by both means.
/// @return false if somebody else holds it, or if the file system has no locks
bool lock_file(int file, bool waits) {
  int flocked = 0, set = 0;
  do flocked = flock(file, LOCK_EX | (waits ? 0 : LOCK_NB));
  while (flocked != 0 && errno == EINTR);
  if (flocked != 0 && errno == EWOULDBLOCK) return false;
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  do set = fcntl(file, waits ? F_OFD_SETLKW : F_OFD_SETLK, &whole);
  while (set != 0 && errno == EINTR);
  if (set != 0 && (errno == EAGAIN || errno == EACCES)) return false;
  return flocked == 0 || set == 0;
}

int open_lock(const OpenDirectory& directory, const std::string& name, int how) {
  return openat(directory.descriptor(), name.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | how, 0600);
}

bool is_file_at(int file, const OpenDirectory& directory, const std::string& name) {
  struct stat own;
  const auto there = directory.look(name);
  return fstat(file, &own) == 0 && there && own.st_dev == there->st_dev && own.st_ino == there->st_ino;
}

OpenDirectory own_folder(const OpenDirectory& directory, const std::string& name) {
  const auto folder = directory.folder(name);
  struct stat status;
  if (!folder || fstat(folder->descriptor(), &status) != 0 || status.st_uid != geteuid())
    throw FileError((directory.name() / name).string() +
                    ": was exchanged while it was made; nothing is written");
  return *folder;
}

std::string made_in(const OpenDirectory& directory) {
  for (;;) {
    auto name = new_name();
    if (mkdirat(directory.descriptor(), name.c_str(), 0700) == 0) return name;
    if (errno != EEXIST)
      throw fs::filesystem_error("making a directory", directory.name() / name,
                                 std::error_code(errno, std::generic_category()));
  }
}

/// The process that made the folder is gone, or has not begun to write: locks are not there for a moment only
/// while the directory is locked.
void remove_if_abandoned(const OpenDirectory& directory, const std::string& name) {
  const auto folder = directory.folder(name);
  struct stat status;
  if (!folder || fstat(folder->descriptor(), &status) != 0 || status.st_uid != geteuid()) return;
  const int lock = open_lock(*folder, lock_of_staging, 0);
  if (lock < 0) return directory.remove_if_empty(name);
  if (lock_file(lock, false)) directory.remove_all(name, lock_of_staging);
  close(lock);
}

struct AllStagings {
  std::mutex mutex;
  std::map<std::string, Staging*> by_path;
};

AllStagings& all_stagings() {
  static AllStagings all;
  return all;
}

}  // namespace

DirectoryLock::DirectoryLock(const OpenDirectory& directory) : directory_(directory) {
  for (;;) {
    file_ = open_lock(directory_, lock_of_directory, O_CREAT);
    if (file_ < 0) {
      const auto why = std::error_code(errno, std::generic_category());
      const bool is_ours_to_write = faccessat(directory_.descriptor(), ".", W_OK, AT_EACCESS) == 0;
      const auto name = directory_.name() / lock_of_directory;
      if (!is_ours_to_write || why == std::errc::read_only_file_system) return;
      if (why == std::errc::permission_denied)
        throw FileError(name.string() +
                        ": is of a run of another user in this directory; wait until it is gone, or choose "
                        "another output with -o");
      throw fs::filesystem_error("locking", name, why);
    }
    lock_file(file_, true);
    if (is_file_at(file_, directory_, lock_of_directory)) return;
    close(file_);  // the process that held it has removed it meanwhile
  }
}

DirectoryLock::~DirectoryLock() {
  if (file_ < 0) return;
  unlinkat(directory_.descriptor(), lock_of_directory.c_str(), 0);
  close(file_);
}

void remove_abandoned(const OpenDirectory& directory) {
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(directory.path()))
    if (const auto name = entry.path().filename().string(); is_staging(name) || name == lock_of_directory)
      left.push_back(name);
  if (left.empty()) return;
  const DirectoryLock lock(directory);
  for (const auto& name : left)
    if (name != lock_of_directory) remove_if_abandoned(directory, name);
}

Staging::Staging(const OpenDirectory& directory)
    : directory_((remove_abandoned(directory), directory)), folder_(directory) {
  const DirectoryLock alone(directory_);
  name_ = made_in(directory_);
  folder_ = own_folder(directory_, name_);
  folder_.call(directory_.name());
  lock_ = open_lock(folder_, lock_of_staging, O_CREAT | O_EXCL);
  if (lock_ < 0) {
    const auto why = std::error_code(errno, std::generic_category());
    directory_.remove_if_empty(name_);
    throw fs::filesystem_error("making a file", folder_.name() / lock_of_staging, why);
  }
  lock_file(lock_, false);
  const std::lock_guard<std::mutex> guard(all_stagings().mutex);
  all_stagings().by_path[folder_.path().string()] = this;
}

Staging::~Staging() {
  {
    const std::lock_guard<std::mutex> guard(all_stagings().mutex);
    all_stagings().by_path.erase(folder_.path().string());
  }
  try {
    if (!is_given_away_) directory_.remove_all(name_, lock_of_staging);
  } catch (const std::exception&) {  // the next one that writes here removes it
  }
  close(lock_);
}

Staging* Staging::of(const fs::path& file) {
  const auto text = file.string();
  const std::lock_guard<std::mutex> guard(all_stagings().mutex);
  for (const auto& [path, staging] : all_stagings().by_path)
    if (text.compare(0, path.size(), path) == 0 && text.size() > path.size() && text[path.size()] == '/')
      return staging;
  return nullptr;
}

void Staging::record(const fs::path& file) {
  const auto name = file.lexically_relative(folder_.path()).generic_string();
  const auto status = folder_.look(name);
  if (!status || !S_ISREG(status->st_mode))
    throw FileError(shown(file) + ": is gone, just after it was written");
  const std::lock_guard<std::mutex> guard(mutex_);
  files_[name] = std::uintmax_t(status->st_size);
}

void Staging::forget(const fs::path& file) {
  const std::lock_guard<std::mutex> guard(mutex_);
  files_.erase(file.lexically_relative(folder_.path()).generic_string());
}

std::map<std::string, std::uintmax_t> Staging::complete_files() const {
  const std::lock_guard<std::mutex> guard(mutex_);
  const auto refuse = [&](const std::string& name, const std::string& why) {
    throw FileError((folder_.name() / name).string() + ": " + why +
                    " while the results were written; they are not put in their places. Run it again");
  };
  for (const auto& [name, size] : files_) {
    const auto status = folder_.look(name);
    if (!status) refuse(name, "was removed");
    if (!S_ISREG(status->st_mode) || std::uintmax_t(status->st_size) != size) refuse(name, "was changed");
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
    const auto name = entry.path().lexically_relative(folder_.path()).generic_string();
    if (!fs::is_directory(entry.symlink_status()) && name != lock_of_staging && files_.count(name) == 0)
      refuse(name, "appeared");
  }
  return files_;
}

void Staging::become(const std::string& name) {
  directory_.move(name_, directory_, name);
  is_given_away_ = true;
}

}  // namespace pipelines
