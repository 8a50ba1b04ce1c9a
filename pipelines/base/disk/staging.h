/// Where files are written until they are complete: a hidden folder in the directory that they will have
/// their place in. Everything that the program writes is written into one of these and moved from there.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "pipelines/base/disk/open_directory.h"

namespace pipelines {

/// A directory is looked at and changed by one process at a time. Held by flock and by a lock of the open
/// file description (fcntl), which file systems that machines share know, on a file in the directory that is
/// gone afterwards. A directory that cannot be written to, and a file system without locks, are used without.
class DirectoryLock {
public:
  /// Waits for others. @throws FileError if the lock belongs to another user
  explicit DirectoryLock(const OpenDirectory& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

private:
  OpenDirectory directory_;
  int file_ = -1;
};

/// The name of the file in a staging folder that is locked.
extern const std::string lock_of_staging;

/// `.millstress-<16 digits>.partial`, of this process alone: made under a name that did not exist, readable
/// by its user only, and held by the same two locks as long as this lives. Whoever is killed leaves it
/// unlocked, and the next that writes into the same directory removes it. The destructor removes it with all
/// that is in it.
class Staging {
public:
  /// @throws std::filesystem::filesystem_error if it cannot be made
  explicit Staging(const OpenDirectory& directory);
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// The folder to write into. Messages call its files by the names that they will have in the directory.
  const OpenDirectory& folder() const noexcept { return folder_; }

  /// The one that it is in.
  const OpenDirectory& directory() const noexcept { return directory_; }

  /// The staging of this process that a file lies in; null: in none.
  static Staging* of(const std::filesystem::path& file);

  /// Remembers a file below the folder as complete. May be called from any thread.
  void record(const std::filesystem::path& file);

  /// Takes a file that is not kept from what was recorded.
  void forget(const std::filesystem::path& file);

  /// The files that were recorded, by their names in the folder, with their sizes.
  /// @throws FileError if one is missing or of another size, or if there are others beside them
  std::map<std::string, std::uintmax_t> complete_files() const;

  /// Gives the folder another name in its directory, with the file that is locked; the destructor does not
  /// remove it then.
  void become(const std::string& name);

private:
  OpenDirectory directory_;
  std::string name_;
  OpenDirectory folder_;
  int lock_ = -1;
  bool is_given_away_ = false;
  mutable std::mutex mutex_;
  std::map<std::string, std::uintmax_t> files_;
};

/// Removes what killed processes have left in a directory: their folders, and a lock that nobody holds.
void remove_abandoned(const OpenDirectory& directory);

}  // namespace pipelines
