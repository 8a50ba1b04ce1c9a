#include "pipelines/base/disk/open_directory.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "pipelines/base/common/errors.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

const std::string open_files = "/proc/self/fd/";
constexpr int how_folders_are_opened = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

[[noreturn]] void disk_fault(const std::string& what, const fs::path& file) {
  throw fs::filesystem_error(what, file, std::error_code(errno, std::generic_category()));
}

/// Names of the directories that are open, or were last, by descriptor.
struct NamesOfDirectories {
  std::mutex mutex;
  std::map<int, fs::path> names;
};

NamesOfDirectories& names_of_directories() {
  static NamesOfDirectories all;
  return all;
}

/// A name below an open directory: its descriptor, and what follows.
struct Below {
  int descriptor;
  fs::path rest;
};

std::optional<Below> below_open_directory(const fs::path& file) {
  const auto text = file.string();
  if (text.compare(0, open_files.size(), open_files) != 0) return std::nullopt;
  char* end = nullptr;
  const long number = std::strtol(text.c_str() + open_files.size(), &end, 10);
  if (end == text.c_str() + open_files.size() || (*end != '\0' && *end != '/')) return std::nullopt;
  while (*end == '/') ++end;
  return Below{int(number), end};
}

/// The parts of a name inside a directory.
/// @throws std::invalid_argument for one that could lead out of it
std::vector<fs::path> parts_of(const fs::path& name) {
  std::vector<fs::path> parts;
  for (const auto& part : name) {
    if (part == ".." || part == "/")
      throw std::invalid_argument(name.string() + ": leads out of a directory");
    if (!part.empty() && part != ".") parts.push_back(part);
  }
  return parts;
}

/// Whether a folder was not opened since it is missing, a link, or no folder.
bool is_no_folder(int error) {
  return error == ENOENT || error == ENOTDIR || error == ELOOP;
}

}  // namespace

std::string shown(const fs::path& file) {
  const auto below = below_open_directory(file);
  if (!below) return file.string();
  const std::lock_guard<std::mutex> lock(names_of_directories().mutex);
  const auto name = names_of_directories().names.find(below->descriptor);
  if (name == names_of_directories().names.end()) return file.string();
  return (below->rest.empty() ? name->second : name->second / below->rest).string();
}

OpenDirectory::OpenDirectory(int descriptor, fs::path name)
    : descriptor_(new int(descriptor),
                  [](const int* number) {
                    close(*number);
                    delete number;
                  }),
      name_(std::move(name)) {
  call(name_);
}

void OpenDirectory::call(fs::path name) {
  name_ = std::move(name);
  const std::lock_guard<std::mutex> lock(names_of_directories().mutex);
  names_of_directories().names[descriptor()] = name_;
}

OpenDirectory OpenDirectory::at(const fs::path& directory) {
  if (const auto below = below_open_directory(directory)) {
    const int again = fcntl(below->descriptor, F_DUPFD_CLOEXEC, 0);
    if (again < 0) disk_fault("opening", directory);
    return OpenDirectory(again, shown(open_files + std::to_string(below->descriptor)))
        .make_folder(below->rest);
  }
  fs::create_directories(directory);
  const int opened = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) disk_fault("opening", directory);
  return {opened, directory};
}

std::optional<OpenDirectory> OpenDirectory::existing(const fs::path& directory) {
  const int opened = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0 && !is_no_folder(errno)) disk_fault("opening", directory);
  return opened < 0 ? std::nullopt : std::optional(OpenDirectory(opened, directory));
}

fs::path OpenDirectory::path() const {
  static const bool has_names = access(open_files.c_str(), X_OK) == 0;
  return has_names ? fs::path(open_files + std::to_string(descriptor())) : name_;
}

void OpenDirectory::require_at(const fs::path& directory) const {
  struct stat own, there;
  if (fstat(descriptor(), &own) == 0 && stat(directory.c_str(), &there) == 0 && own.st_dev == there.st_dev &&
      own.st_ino == there.st_ino)
    return;
  throw OptionError(shown(directory) +
                    ": is another directory now than when this run began to write there, and nothing is put "
                    "into it; leave the directory in its place, or choose another output with -o");
}

std::optional<OpenDirectory> OpenDirectory::folder(const fs::path& folder) const {
  auto at = *this;
  for (const auto& part : parts_of(folder)) {
    const int opened = openat(at.descriptor(), part.c_str(), how_folders_are_opened);
    if (opened < 0 && is_no_folder(errno)) return std::nullopt;
    if (opened < 0) disk_fault("opening", at.name_ / part);
    at = OpenDirectory(opened, at.name_ / part);
  }
  return at;
}

OpenDirectory OpenDirectory::make_folder(const fs::path& folder) const {
  auto at = *this;
  for (const auto& part : parts_of(folder)) {
    if (mkdirat(at.descriptor(), part.c_str(), 0777) != 0 && errno != EEXIST)
      disk_fault("making a directory", at.name_ / part);
    const int opened = openat(at.descriptor(), part.c_str(), how_folders_are_opened);
    if (opened < 0 && is_no_folder(errno))
      throw OptionError((at.name_ / part).string() +
                        ": is a symbolic link or no directory, and nothing is written through it; choose "
                        "another output with -o, or move it away");
    if (opened < 0) disk_fault("opening", at.name_ / part);
    at = OpenDirectory(opened, at.name_ / part);
  }
  return at;
}

std::optional<OpenDirectory> OpenDirectory::parent_of(const fs::path& file) const {
  return folder(file.parent_path());
}

std::optional<struct stat> OpenDirectory::look(const fs::path& file) const {
  const auto parent = parent_of(file);
  struct stat status;
  if (!parent || fstatat(parent->descriptor(), file.filename().c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
    return std::nullopt;
  return status;
}

fs::path OpenDirectory::obstacle_before(const fs::path& file) const {
  fs::path before;
  for (const auto& part : parts_of(file.parent_path())) {
    before /= part;
    const auto status = look(before);
    if (!status) return {};
    if (!S_ISDIR(status->st_mode)) return before;
  }
  return {};
}

void OpenDirectory::move(const fs::path& from, const OpenDirectory& other, const fs::path& to) const {
  const auto source = parent_of(from);
  const auto target = other.make_folder(to.parent_path());
  if (!source) errno = ENOENT;
  if (!source || renameat(source->descriptor(), from.filename().c_str(), target.descriptor(),
                          to.filename().c_str()) != 0)
    disk_fault("moving", other.name_ / to);
}

void OpenDirectory::remove(const fs::path& file) const {
  const auto parent = parent_of(file);
  if (parent && unlinkat(parent->descriptor(), file.filename().c_str(), 0) != 0 && errno != ENOENT)
    disk_fault("removing", name_ / file);
}

void OpenDirectory::remove_if_empty(const fs::path& folder) const {
  if (const auto parent = parent_of(folder))
    unlinkat(parent->descriptor(), folder.filename().c_str(), AT_REMOVEDIR);
}

void OpenDirectory::remove_all(const fs::path& folder, const std::string& last) const {
  const auto opened = this->folder(folder);
  if (!opened) return;
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(opened->path())) names.push_back(entry.path().filename());
  std::stable_partition(names.begin(), names.end(), [&](const fs::path& name) { return name != last; });
  for (const auto& name : names) {
    const auto status = opened->look(name);
    if (status && S_ISDIR(status->st_mode))
      opened->remove_all(name);
    else
      opened->remove(name);
  }
  remove_if_empty(folder);
}

}  // namespace pipelines
