/// The names that a run gives to files, and what may be replaced or removed by them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

/// Whether a file in a body's folder has a name that the program gives.
bool is_body_file(const std::string& name);

/// Of those: kept for the next run, and no result of this one.
bool is_kept_file(const std::string& name);

/// Refuses a result directory in which a run would replace what is not its own: a link, a pipe, a device, an
/// input of this run; or, where no earlier run has left its manifest or summary, any file with a result's
/// name. Touches nothing.
/// @param bodies  names of the folders that the run will write
/// @throws OptionError naming -o, the file and the remedy
void refuse_foreign_files(const std::filesystem::path& directory, const std::vector<std::string>& bodies);

/// The bodies that the run had which wrote a summary.json; none if this program did not write it.
std::vector<std::string> bodies_of_summary(const std::filesystem::path& file);

}  // namespace pipelines
