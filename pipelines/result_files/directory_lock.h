/// A result directory is looked at and exchanged by one process at a time.
#pragma once

#include <filesystem>

namespace pipelines {

/// Two runs that end at the same time exchange one after the other. A file system without locks is used
/// without, and so is a directory that does not exist.
class DirectoryLock {
public:
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

private:
  int file_;
};

}  // namespace pipelines
