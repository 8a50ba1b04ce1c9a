/// Results of a run in a hidden folder beside the earlier ones until all are written. Then they take their
/// places together:
///
///   .results.<host>.<process>-<n>.partial   while they are written; removed if the run fails or is killed
///   .results.complete                       all written, with their manifest, and on the disk
///
/// From the second name on, the new results are the ones that count: whoever finds that folder, a later run
/// or `report`, moves what is still in it to its place. Before it, nothing of the earlier results is touched.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

class StagedResults {
public:
  /// Finishes what a killed run has left, and makes the hidden folder.
  /// @param bodies  names of the folders that the run will write
  /// @throws OptionError if something in `directory` must not be replaced (result_names.h)
  /// @throws std::filesystem::filesystem_error if the directory cannot be made
  StagedResults(std::filesystem::path directory, std::vector<std::string> bodies);
  ~StagedResults();
  StagedResults(const StagedResults&) = delete;
  StagedResults& operator=(const StagedResults&) = delete;

  /// Where to write, under the names that the files will have in the result directory.
  const std::filesystem::path& folder() const noexcept { return folder_; }

  /// For the user, where the earlier results were not as their run had written them; empty otherwise.
  const std::string& warning() const noexcept { return warning_; }

  /// Puts everything that is in the folder into its place, with a manifest, and removes what earlier runs
  /// have left under names that results have: for bodies that this run does not have their unit responses
  /// too. Files with other names stay.
  /// @throws OptionError if something would be replaced that must not be; nothing is touched then
  /// @throws FileError, std::filesystem::filesystem_error if the disk does not take it
  void publish();

private:
  std::filesystem::path directory_;
  std::vector<std::string> bodies_;
  std::filesystem::path folder_;
  std::string warning_;
};

/// Moves the results of a run that was killed on the way to their places, if there are any.
/// @throws std::filesystem::filesystem_error if they cannot be moved
void finish_exchange(const std::filesystem::path& directory);

}  // namespace pipelines
