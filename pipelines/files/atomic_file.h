/// Files that appear complete or not at all: written under another name in the same directory, then renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pipelines {

/// The name to write to until the content is complete. Without commit() the destructor removes what was
/// written and the target keeps its old content; so it does when an exception passes or the process is
/// killed. What a killed process left behind is removed when the same target is written again on the same
/// machine.
class AtomicFile {
public:
  /// Makes the directory of the target if it is missing; creates no file yet.
  /// @throws std::filesystem::filesystem_error if the directory cannot be made
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write. Close the file before commit().
  const std::filesystem::path& temporary() const noexcept { return temporary_; }

  /// Puts the written file in the place of the target. File and name are on the disk when it returns: a loss
  /// of power harms neither the old content nor the new one.
  /// @param end  what the file has to end with: libraries that write files do not always tell that the disk
  ///             was full
  /// @throws OptionError if the target is no regular file, or an input of this process (replaceable.h)
  /// @throws FileError if the file is cut, or cannot be brought to the disk
  /// @throws std::filesystem::filesystem_error if nothing was written or the target cannot be replaced
  void commit(std::string_view end = {});

private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// A name for what is not complete yet, hidden and unique among threads, processes and machines, beside the
/// target. Removes what processes of this machine that are gone have left under such names, files or folders,
/// and makes the directory of the target.
/// @throws std::filesystem::filesystem_error if the directory cannot be made
std::filesystem::path partial_name(const std::filesystem::path& target);

/// Removes what processes of this machine that are gone have left in a directory under such names, whatever
/// the target.
void remove_partial_names(const std::filesystem::path& directory);

/// Waits until a file's content, or a directory's names, are on the disk.
/// @throws FileError if that fails; file systems that cannot tell are believed
void bring_to_disk(const std::filesystem::path& file_or_directory);

/// Writes a whole file in one go.
/// @throws FileError naming the file if it cannot be written; as AtomicFile::commit
void write_text_file(const std::filesystem::path& path, std::string_view content);

}  // namespace pipelines
