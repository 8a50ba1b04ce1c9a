/// The one owner of all files that a command writes into a directory. They are written into a hidden folder
/// beside the earlier ones until all are complete. Then they take their places together:
///
///   .millstress-<16 digits>.partial   while they are written; removed if the command fails or is killed
///   .results.complete                 all written, with the manifest of the directory, and on the disk
///
/// From the second name on, the new results are the ones that count: whoever finds that folder, a later run
/// or `report`, moves what is still in it to its place. Before it, nothing of the earlier results is touched.
///
/// What is there already is this program's if the manifest of the directory lists it with the checksum that
/// it has. Nothing else is replaced or removed, and nothing is read or written through a link in the
/// directory. Several commands share a directory and its manifest.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/disk/staging.h"
#include "pipelines/write/files/result_names.h"
#include "pipelines/write/files/variant.h"

namespace pipelines {

class StagedResults {
public:
  /// Finishes what a killed run has left, and makes the hidden folder.
  /// @param names   names of all that the command may write
  /// @param option  that named the directory
  /// @param variant  what they are of, for the manifest; nothing: what it says stays
  /// @throws OptionError naming option, file and remedy if a file with one of the names is not this program's
  /// @throws std::filesystem::filesystem_error if the directory cannot be made
  StagedResults(std::filesystem::path directory, OutputNames names, std::string option = "-o",
                std::optional<Variant> variant = {});
  StagedResults(const StagedResults&) = delete;
  StagedResults& operator=(const StagedResults&) = delete;

  /// The folder to write into, under the names that the files will have in the directory.
  std::filesystem::path folder() const { return staging_.folder().path(); }

  /// The directory itself, wherever its name leads meanwhile: for what is kept between runs.
  std::filesystem::path directory() const { return directory_.path(); }

  /// Puts everything that was written into its place, with the manifest, and removes what earlier commands
  /// have left under names that this one gives.
  /// @throws OptionError if something would be replaced that must not be, or if results of another variant
  ///         have come there meanwhile; nothing is touched then
  /// @throws FileError, std::filesystem::filesystem_error if the disk does not take it, or if not exactly
  /// what
  ///         was written is there
  void publish();

private:
  /// Directories that were not there. Those that stay empty go again.
  struct MissingDirectories {
    std::vector<std::filesystem::path> names;  ///< the innermost first
    ~MissingDirectories();
  };

  std::filesystem::path name_;
  MissingDirectories missing_;
  OutputNames names_;
  std::string option_;
  std::optional<Variant> variant_;
  OpenDirectory directory_;
  std::optional<ResultsOf> found_;  ///< what the directory held at first
  Staging staging_;
};

/// @param option  that named the directory, for the message
/// @throws OptionError naming option, file and remedy if a file with one of the names is not this program's;
///         touches nothing
void require_own_outputs(const OpenDirectory& directory, const OutputNames& names,
                         const std::string& option = "-o");

/// The same for a directory that need not be there, where what a killed run has left has been finished.
void require_own_outputs(const std::filesystem::path& directory, const OutputNames& names,
                         const std::string& option = "-o");

/// Makes report.html of a result directory anew, of the files that are there.
/// @param accuracy  as html_report
/// @param option  that named the directory, for the message
/// @throws as html_report and StagedResults; OptionError where a run has kept its report alone
void publish_html_report(const std::filesystem::path& directory, const std::filesystem::path& accuracy,
                         const std::string& option = "-o");

/// Moves the results of a run that was killed on the way to their places, if there are any.
/// @throws OptionError if what waits there is not what a run has left there complete, or if a file in one of
///         the places is not this program's; nothing is touched then
/// @throws std::filesystem::filesystem_error if they cannot be moved
void finish_exchange(const std::filesystem::path& directory);

}  // namespace pipelines
