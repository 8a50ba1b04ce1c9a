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
  std::string key;                                ///< run_key
  std::map<std::string, std::string> kept_under;  ///< SceneRun::kept_under
  std::vector<std::string> warnings;              ///< lines on stderr that belong to the results
  std::string table{};                            ///< as printed, ended by a line feed
  std::string full_table{};                       ///< as printed with -v, likewise
};

/// Leaves the record among results that wait for their places. None where the record would say less than the
/// run: without a key, or with text that is not UTF-8.
/// @throws FileError if it cannot be written
void write_run_record(const std::filesystem::path& folder, const RunRecord& record);

/// A run whose results are in their places, whole.
struct EarlierRun {
  RunRecord record;
  std::string summary;  ///< text of summary.json
};

/// Reads all results to find out that they are as the run wrote them: those in the manifest, report.html, and
/// what is kept for later runs, which may also be gone. Finishes what a killed run has left; writes nothing
/// otherwise.
/// @param bodies  names of the folders that the run writes
/// @return empty unless the directory has the whole results of a run with this key
/// @throws OptionError if something in the directory must not be replaced by a run (result_names.h)
std::optional<EarlierRun> earlier_run(const std::filesystem::path& directory,
                                      const std::vector<std::string>& bodies, const std::string& key);

}  // namespace pipelines
