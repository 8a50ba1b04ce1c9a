/// What the options of a command would write, looked at before anything runs.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace pipelines {

/// A file that an option writes.
struct OutputFile {
  std::string option;  ///< as on the command line
  std::filesystem::path file;
};

/// The files that an option writes into its directory. None if the directory is empty: the option was not
/// given.
std::vector<OutputFile> output_files(const std::string& option, const std::filesystem::path& directory,
                                     const std::vector<std::string>& names);

/// A line on std::cerr if a command that draws charts has drawn none since the machine cannot.
void say_if_nothing_draws(const std::vector<std::string>& charts, bool can_draw);

/// The last line of a command: which charts it has written, and where. Nothing if there are none.
void print_files(std::ostream& out, const std::filesystem::path& directory,
                 const std::vector<std::string>& names);

/// @throws OptionError naming option, file and remedy if two of them are one file
void require_different(const std::vector<OutputFile>& outputs);

}  // namespace pipelines
