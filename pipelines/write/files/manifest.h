/// manifest.json of a result directory: the files that commands of this program have written there, with
/// sizes and checksums. A file that it lists as it is, is this program's and may be replaced or removed; and
/// what a run has written shows as one whole.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/disk/open_directory.h"

namespace pipelines {

inline constexpr const char* manifest_name = "manifest.json";

struct ListedFile {
  std::uintmax_t bytes = 0;
  std::string checksum;  ///< content_hash
};

/// Listed files by names relative to the directory.
using FileList = std::map<std::string, ListedFile>;

/// @return empty without a manifest, or with one that is damaged, not of this program, or that has names
/// which
///         lead out of the directory or are hidden
std::optional<FileList> read_manifest(const OpenDirectory& directory);

/// The scene, settings and options that made the files of a directory (variant.h).
struct ResultsOf {
  std::string scene;                                ///< its file, relative to the directory
  std::vector<std::string> settings;                ///< --set, "KEY=VALUE", sorted
  std::optional<std::vector<std::string>> sweep{};  ///< options of a sweep; nothing: there is none

  bool operator==(const ResultsOf& other) const {
    return scene == other.scene && settings == other.settings && sweep == other.sweep;
  }
};

/// @return empty without a manifest, or with one that does not say so
std::optional<ResultsOf> read_results_of(const OpenDirectory& directory);

/// The same, with what is no UTF-8 as it comes back from a manifest.
ResultsOf as_json_has_it(ResultsOf of);

/// The whole text of a manifest.
std::string manifest_text(const FileList& files, const std::optional<ResultsOf>& of = {});

/// Whether a file, behind no link, has the size and the content that are listed. Reads all of it.
bool is_as_listed(const OpenDirectory& directory, const std::string& name, const ListedFile& listed);

/// A file as it is now.
ListedFile listed_now(const OpenDirectory& directory, const std::string& name);

/// What a manifest and the files of a run beside it say about each other. Names are relative to the
/// directory.
struct ManifestCheck {
  bool is_there = false;  ///< a manifest
  bool damaged = false;   ///< it cannot be read, or its own checksum does not fit
  /// Files of a run that it lists, but for report.html, which `report` replaces.
  std::vector<std::string> files;
  std::vector<std::string> changed;  ///< files of another size or content, or no regular files any more
  std::vector<std::string> missing;

  /// Whether files are there that the run has not written so.
  bool is_mixed() const { return damaged || !changed.empty(); }
  /// Words for the user, where it is mixed: the directory and what is wrong.
  std::string text(const std::filesystem::path& directory) const;
};

/// Reads all files of a run that are listed.
ManifestCheck check_manifest(const std::filesystem::path& directory);

}  // namespace pipelines
