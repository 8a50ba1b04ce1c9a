/// The program as a user starts it, with limits.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fuzz {

struct ProgramEnd {
  int exit_code = -1;
  int signal = 0;  ///< that ended it
  std::string out, err;
};

/// @param outside          its output and what libraries cache lie there
/// @param seconds_of_core  after these a signal ends it
ProgramEnd run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                       const std::filesystem::path& directory, const std::filesystem::path& outside,
                       double seconds_of_core);

/// Limits of this process, for good.
/// @param seconds_on_the_clock  after these SIGALRM ends it
void limit_this_process(double seconds_of_core, double seconds_on_the_clock);

/// Seconds of a core of this process and of its children that have ended.
double seconds_used();

}  // namespace fuzz
