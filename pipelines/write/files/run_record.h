/// run.json of a result directory: what its run depended on, as a hash, and what it printed. The same run
/// asked for again computes nothing: it prints this.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/files/replaceable.h"
#include "pipelines/scene/values/requested_accuracy.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

inline constexpr const char* run_record_name = "run.json";

/// Hash of all that results depend on: the program, the scene's file name (however its folder is written),
/// what --set gave, the content of every input, method, accuracy, threads, ranks.
/// @param scene      as the options have it
/// @param n_threads  above 0
/// @param inputs     all that reading the scene has noted
/// @return empty if an input is no regular file that can be read: such a run is never unchanged
std::string run_key(const Scene& scene, const RequestedAccuracy& accuracy, int n_threads, int n_ranks,
                    const std::vector<NotedInput>& inputs);

struct RunRecord {
  std::string key;                               ///< run_key; empty: never the same as a later run
  std::map<std::string, std::string> responses;  ///< by body the hash of the key of its unit responses
  std::vector<std::string> warnings;             ///< lines on stderr that belong to the results
  std::string table{};                           ///< as printed, ended by a line feed
  std::string full_table{};                      ///< as printed with -v, likewise
  bool is_report_alone = false;                  ///< of the results only summary.json and the page were kept
};

/// Leaves the record among results that wait for their places; of text that is not UTF-8 only which unit
/// responses are the run's.
/// @throws FileError if it cannot be written
void write_run_record(const std::filesystem::path& folder, const RunRecord& record);

/// @return an empty one if the file is none
RunRecord read_run_record(const std::filesystem::path& file);

/// A run whose results are in their places, whole.
struct EarlierRun {
  RunRecord record;
  std::string summary;  ///< text of summary.json
};

/// Reads all results to find out that they are as the run wrote them: those in the manifest, report.html, and
/// unit responses in the user's cache, which may also be gone. Finishes what a killed run has left; writes
/// nothing otherwise.
/// @param bodies  names of the folders that the run writes
/// @param with_responses  unit responses are needed, too: none may be gone
/// @return empty unless the directory has the whole results of a run with this key
/// @throws OptionError if something in the directory must not be replaced by a run (result_names.h)
std::optional<EarlierRun> earlier_run(const std::filesystem::path& directory,
                                      const std::vector<std::string>& bodies, const std::string& key,
                                      bool with_responses = false);

}  // namespace pipelines
