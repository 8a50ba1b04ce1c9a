/// Directories that are opened once. Wherever their names lead to later, what is done through one of these is
/// done in the directory that was opened, and through no symbolic link inside it.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace pipelines {

/// Copies are of one open directory. Names of files and folders in it are relative and never lead out of it;
/// "shaft/zones.csv" is one.
class OpenDirectory {
public:
  /// Makes it if it is missing. Links in the name are followed, as the user has given it; but none behind the
  /// path() of an open directory, which the name may begin with.
  /// @throws std::filesystem::filesystem_error if it cannot be made or opened; OptionError as `make_folder`
  static OpenDirectory at(const std::filesystem::path& directory);

  /// @return empty if there is no such directory
  static std::optional<OpenDirectory> existing(const std::filesystem::path& directory);

  /// A name that leads to it as long as it is open, for libraries that write by name. Files below it are
  /// called by `shown` in messages.
  std::filesystem::path path() const;

  /// The directory's name as the user knows it.
  const std::filesystem::path& name() const noexcept { return name_; }

  /// Has it called by another name in messages.
  void call(std::filesystem::path name);

  /// @throws OptionError if a name does not lead to this directory now
  void require_at(const std::filesystem::path& directory) const;

  /// @return empty if there is none, or if it is a link or lies behind one
  std::optional<OpenDirectory> folder(const std::filesystem::path& folder) const;

  /// @throws OptionError if it is no folder, or is or lies behind a link
  OpenDirectory make_folder(const std::filesystem::path& folder) const;

  /// State of a file, folder or link itself. @return empty if there is none, or if it lies behind a link
  std::optional<struct stat> look(const std::filesystem::path& file) const;

  /// The first of the folders before the last part of a name that is there and is no folder; empty: none.
  std::filesystem::path obstacle_before(const std::filesystem::path& file) const;

  /// Moves a file or folder, over what is there, and makes the folder that it goes to.
  void move(const std::filesystem::path& from, const OpenDirectory& other,
            const std::filesystem::path& to) const;

  /// Does nothing where there is no such file.
  void remove(const std::filesystem::path& file) const;

  /// Does nothing where it is no folder, or not an empty one.
  void remove_if_empty(const std::filesystem::path& folder) const;

  /// Removes a folder with all that is in it; links themselves, and nothing behind them.
  /// @param last  name in the folder that goes after the others
  void remove_all(const std::filesystem::path& folder, const std::string& last = "") const;

  int descriptor() const noexcept { return *descriptor_; }

private:
  OpenDirectory(int descriptor, std::filesystem::path name);
  /// The parent of a file in it, and the file's name there.
  std::optional<OpenDirectory> parent_of(const std::filesystem::path& file) const;

  std::shared_ptr<const int> descriptor_;
  std::filesystem::path name_;
};

/// How the user knows a file: below the path() of an OpenDirectory by that directory's name.
std::string shown(const std::filesystem::path& file);

}  // namespace pipelines
