/// Programs run as children, and what they took.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace measure {

struct ChildCost {
  bool finished = false;  ///< of itself, with exit code 0
  bool timed_out = false;
  double wall_s = 0, cpu_s = 0;
  double peak_gigabytes = 0;  ///< resident, of the child alone
};

/// Runs a command in a directory; its output goes to `log` there. Killed after the time limit.
/// @param environment  "NAME=value" each, added to ours
/// @throws std::runtime_error if no process can be started
ChildCost run_child(const std::vector<std::string>& command, const std::filesystem::path& directory,
                    const std::string& log, const std::vector<std::string>& environment, double time_limit_s);

}  // namespace measure
