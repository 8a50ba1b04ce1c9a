#include "tests/benchmarks/calculix/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>

namespace measure {
namespace {

double seconds(const timeval& time) {
  return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

/// In the child: never returns.
[[noreturn]] void become(const std::vector<char*>& arguments, const std::filesystem::path& directory,
                         const std::string& log, const std::vector<std::string>& environment) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // no CalculiX is left behind when the benchmark is interrupted
  if (chdir(directory.c_str()) != 0) _exit(126);
  const int out = open(log.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
  if (out < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0) _exit(126);
  for (const auto& entry : environment) putenv(const_cast<char*>(entry.c_str()));
  execvp(arguments.front(), arguments.data());
  _exit(127);
}

}  // namespace

ChildCost run_child(const std::vector<std::string>& command, const std::filesystem::path& directory,
                    const std::string& log, const std::vector<std::string>& environment,
                    double time_limit_s) {
  std::vector<char*> arguments;
  for (const auto& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  const auto since = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process could be started for " + command.front());
  if (child == 0) become(arguments, directory, log, environment);

  ChildCost cost;
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, WNOHANG, &usage) == 0) {
    if (!cost.timed_out && since() > time_limit_s) {
      cost.timed_out = true;
      kill(child, SIGKILL);
    }
    usleep(20000);
  }
  cost.wall_s = since();
  cost.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  cost.peak_gigabytes = 1024e-9 * double(usage.ru_maxrss);
  cost.finished = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return cost;
}

}  // namespace measure
