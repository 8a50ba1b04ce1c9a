#include "tests/fuzz/child.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "tests/fuzz/verdicts.h"

namespace fuzz {
namespace {

namespace fs = std::filesystem;

double seconds_of(const timeval& time) {
  return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

void redirect(const fs::path& file, int to) {
  const int out = ::open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  if (out < 0 || ::dup2(out, to) < 0) ::_exit(126);
}

[[noreturn]] void become(const std::vector<char*>& words, const fs::path& directory, const fs::path& outside,
                         double seconds_of_core) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::chdir(directory.c_str()) != 0) ::_exit(126);
  redirect(outside / "out", STDOUT_FILENO);
  redirect(outside / "err", STDERR_FILENO);
  ::setenv("XDG_CACHE_HOME", (outside / "cache").c_str(), 1);
  // Libraries that end with a program never free what they hold; workers look for leaks of ours.
  const char* const options = std::getenv("ASAN_OPTIONS");
  ::setenv("ASAN_OPTIONS", ((options != nullptr ? options : "") + std::string(":detect_leaks=0")).c_str(), 1);
  rlimit no_cores{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_cores);
  limit_this_process(seconds_of_core, 20 * seconds_of_core);
  ::execv(words.front(), words.data());
  ::_exit(127);
}

}  // namespace

ProgramEnd run_program(const fs::path& program, const std::vector<std::string>& arguments,
                       const fs::path& directory, const fs::path& outside, double seconds_of_core) {
  auto texts = arguments;
  texts.insert(texts.begin(), program.string());
  std::vector<char*> words;
  for (auto& text : texts) words.push_back(text.data());
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process can be started");
  if (child == 0) become(words, directory, outside, seconds_of_core);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  ProgramEnd end;
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  end.out = read_bytes(outside / "out");
  end.err = read_bytes(outside / "err");
  return end;
}

void limit_this_process(double seconds_of_core, double seconds_on_the_clock) {
  rlimit limit{};
  ::getrlimit(RLIMIT_CPU, &limit);
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  limit.rlim_cur = rlim_t(std::ceil(seconds_of(used.ru_utime) + seconds_of(used.ru_stime) + seconds_of_core));
  ::setrlimit(RLIMIT_CPU, &limit);
  ::alarm(unsigned(std::ceil(seconds_on_the_clock)));
}

double seconds_used() {
  double sum = 0;
  for (const auto whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    ::getrusage(whose, &used);
    sum += seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  }
  return sum;
}

}  // namespace fuzz
