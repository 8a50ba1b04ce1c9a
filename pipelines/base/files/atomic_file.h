/// Files that appear complete or not at all: written elsewhere (staging.h), then moved to their places.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace pipelines {

class Staging;

/// Says of a file that is there whether this program has written it.
using IsOwnFile = std::function<bool(const std::filesystem::path&)>;

/// A file that is written under another name until its content is complete. Without commit() the destructor
/// removes what was written and the target keeps its old content; so it does when an exception passes or the
/// process is killed. What a killed process left behind is removed when something is written into the same
/// directory again.
///
/// A target below a staging folder of this process is written in its place there, and commit() enters it into
/// the list of what belongs to the results.
class AtomicFile {
public:
  /// Makes the directory of the target if it is missing; creates no file yet.
  /// @param is_own  whether a file under the target's name may be replaced; none: any regular file may
  /// @throws std::filesystem::filesystem_error if the directory cannot be made
  explicit AtomicFile(std::filesystem::path target, IsOwnFile is_own = {});
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The file to write into. Close it before commit().
  const std::filesystem::path& temporary() const noexcept { return temporary_; }

  /// Puts the written file in the place of the target. File and name are on the disk when it returns: a loss
  /// of power harms neither the old content nor the new one. (In a staging folder this is left to the whole.)
  /// @param end  what the file has to end with: libraries that write files do not always tell that the disk
  ///             was full
  /// @throws OptionError if the target is no regular file, an input of this process (replaceable.h), or not
  ///         this program's
  /// @throws FileError if the file is cut, or cannot be brought to the disk
  /// @throws std::filesystem::filesystem_error if nothing was written or the target cannot be replaced
  void commit(std::string_view end = {});

private:
  std::filesystem::path target_, temporary_;
  IsOwnFile is_own_;
  std::unique_ptr<Staging> staging_;  ///< staging of this file alone
  bool committed_ = false;
};

/// @param option  the option that named the file, for the message; empty: none did
/// @throws OptionError naming option, file and remedy if a file is there that must not be replaced
///         (replaceable.h), or that is not this program's. An empty one is nobody's.
void require_own(const std::filesystem::path& file, const IsOwnFile& is_own, const std::string& option = "");

/// Waits until a file's content, or a directory's names, are on the disk.
/// @throws FileError if that fails; file systems that cannot tell are believed
void bring_to_disk(const std::filesystem::path& file_or_directory);

/// Writes a whole file in one go.
/// @throws FileError naming the file if it cannot be written; as AtomicFile::commit
void write_text_file(const std::filesystem::path& path, std::string_view content,
                     const IsOwnFile& is_own = {});

}  // namespace pipelines
