/// manifest.json of a result directory: the files that one run has written, with sizes and checksums. It
/// tells whether what lies there together belongs together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

inline constexpr const char* manifest_name = "manifest.json";

/// Lists every file below `directory` but the manifest itself and report.html, which is made from the others
/// and may be made again.
/// @throws FileError if it cannot be written
void write_manifest(const std::filesystem::path& directory);

/// What a manifest and the files beside it say about each other. Names are relative to the directory.
struct ManifestCheck {
  bool is_there = false;             ///< a manifest
  bool damaged = false;              ///< it cannot be read, or its own checksum does not fit
  std::vector<std::string> files;    ///< that it lists
  std::vector<std::string> changed;  ///< of another size or content, or no regular files any more
  std::vector<std::string> missing;

  /// Whether files are there that the run has not written so.
  bool is_mixed() const { return damaged || !changed.empty(); }
  /// For the user, where it is mixed: the directory and what is wrong.
  std::string text(const std::filesystem::path& directory) const;
};

/// Reads all files that are listed.
ManifestCheck check_manifest(const std::filesystem::path& directory);

/// The list alone; empty without a manifest that can be believed.
std::vector<std::string> files_of_manifest(const std::filesystem::path& directory);

}  // namespace pipelines
