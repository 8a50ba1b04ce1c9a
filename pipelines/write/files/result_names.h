/// The names that commands give to files below a directory.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pipelines {

/// All names that a command may give, those of an earlier call of it with other options too: a file that has
/// one is either this program's or stops the command.
struct OutputNames {
  /// Whether a file may have that name, relative to the directory: "shaft/zones.csv".
  std::function<bool(const std::string&)> has;
  std::function<bool(const std::string&)> enters;  ///< whether files may be in the folder of that name
};

/// Allows exactly these names.
OutputNames names_of(std::vector<std::string> names);

/// Allows names of a form in the directory itself.
/// @param form  a regular expression for the whole name
OutputNames names_like(const std::string& form);

/// Allows the names of a run.
/// @param bodies  the folders that it will write; it removes results from those of other bodies
OutputNames run_names(std::vector<std::string> bodies);

/// Whether a run gives a name to a result, but for report.html, which `report` replaces alone.
bool is_run_result(const std::string& name);

/// Unit responses in a body's folder, where the scene keeps them.
inline constexpr const char* responses_file_name = "unit_responses.h5";

}  // namespace pipelines
