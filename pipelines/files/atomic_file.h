/// Files that appear complete or not at all: written under another name in the same directory, then renamed.
#pragma once

#include <filesystem>
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

  /// Puts the written file in the place of the target.
  /// @throws std::filesystem::filesystem_error if nothing was written or the target cannot be replaced
  void commit();

private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// Writes a whole file in one go.
/// @throws FileError naming the file if it cannot be written
void write_text_file(const std::filesystem::path& path, std::string_view content);

}  // namespace pipelines
