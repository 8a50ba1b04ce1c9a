#include "meshes/imported/apart.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <optional>

#include "meshes/values/refused.h"

namespace meshes {

namespace {

constexpr int exit_too_large = 90;  // any code that the libraries do not use
constexpr double wall_share = 10;   // seconds on the wall for one of a core, where others take turns
constexpr double least_bytes = 1e9;

using Clock = std::chrono::steady_clock;
std::optional<Clock::time_point> deadline;  // set by DeadlineApart; a child has its parent's

double seconds_to_deadline() {
  if (!deadline) return std::numeric_limits<double>::infinity();
  return std::chrono::duration<double>(*deadline - Clock::now()).count();
}

/// SIGALRM after so many seconds on the wall.
void ring_after(double seconds) {
  constexpr double least_s = 1e-3, most_s = 1e9;  // 0 would mean never
  const double s = std::clamp(seconds, least_s, most_s);
  itimerval timer{};
  timer.it_value.tv_sec = time_t(s);
  timer.it_value.tv_usec = suseconds_t(1e6 * (s - std::floor(s)));
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

/// A file without a name, in memory.
class Sheet {
public:
  Sheet() : file_(::memfd_create("millstress", MFD_CLOEXEC)) {
    if (file_ < 0)
      throw MeshRefused(std::string("no memory for the import's results: ") + std::strerror(errno));
  }
  ~Sheet() { ::close(file_); }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  int file() const { return file_; }
  bool write(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const auto n = ::write(file_, text.data() + done, text.size() - done);
      if (n < 0 && errno != EINTR) return false;
      if (n > 0) done += std::size_t(n);
    }
    return true;
  }
  std::string read() const {
    std::string text(std::size_t(std::max<off_t>(0, ::lseek(file_, 0, SEEK_END))), ' ');
    std::size_t done = 0;
    while (done < text.size()) {
      const auto n = ::pread(file_, &text[done], text.size() - done, off_t(done));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      done += std::size_t(n);
    }
    text.resize(done);
    return text;
  }

private:
  int file_;
};

/// Memory that can be taken without paging, and that this process has mapped already.
double free_bytes() {
  std::ifstream in("/proc/meminfo");
  std::string word;
  double kilobytes = 0;
  while (in >> word)
    if (word == "MemAvailable:" && in >> kilobytes) return 1024 * kilobytes;
  return least_bytes;
}
double mapped_bytes() {
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * double(::sysconf(_SC_PAGE_SIZE));
}

void set_limit(__rlimit_resource_t what, double value) {
  rlimit limit{};
  ::getrlimit(what, &limit);
  limit.rlim_cur = std::min(limit.rlim_max, rlim_t(value));
  ::setrlimit(what, &limit);
}

[[noreturn]] void be_the_child(const std::function<std::string()>& work, double seconds, double bytes,
                               const Sheet& result, const Sheet& log, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it was gone before it could be asked for
  for (const int signal :
       {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGXCPU, SIGALRM, SIGTERM, SIGINT, SIGHUP})
    std::signal(signal, SIG_DFL);
  ::dup2(log.file(), STDOUT_FILENO);
  ::dup2(log.file(), STDERR_FILENO);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_AS, bytes);
  limit_rest_apart(seconds);
  try {
    ::_exit(result.write(work()) ? 0 : exit_too_large);
  } catch (const std::bad_alloc&) {
    ::_exit(exit_too_large);
  }
}

}  // namespace

void limit_rest_apart(double seconds) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const double so_far_s = double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1;
  set_limit(RLIMIT_CPU, std::ceil(so_far_s + seconds));
  ring_after(std::min(1 + wall_share * seconds, seconds_to_deadline()));
}

DeadlineApart::DeadlineApart(double seconds) {
  constexpr double most_s = 1e9;
  deadline = Clock::now() + std::chrono::microseconds(std::int64_t(1e6 * std::clamp(seconds, 0.0, most_s)));
}
DeadlineApart::~DeadlineApart() {
  deadline.reset();
}

EndApart run_apart(const std::function<std::string()>& work, double seconds) {
  const Sheet result, log;
  const double bytes = mapped_bytes() + std::max(least_bytes, free_bytes());
  const pid_t parent = ::getpid();
  std::fflush(nullptr);  // or the child would print it again
  const pid_t child = ::fork();
  if (child < 0)
    throw MeshRefused(std::string("no process can be started for the import: ") + std::strerror(errno));
  if (child == 0) be_the_child(work, seconds, bytes, result, log, parent);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      throw MeshRefused(std::string("the import's process cannot be waited for: ") + std::strerror(errno));
  EndApart end;
  end.log = log.read();
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGXCPU || signal == SIGALRM) {
    end.kind = seconds_to_deadline() <= 0 ? EndApart::Kind::too_late : EndApart::Kind::too_slow;
  } else if (signal == 0 && WEXITSTATUS(status) == exit_too_large) {
    end.kind = EndApart::Kind::too_large;
  } else if (signal != 0 || WEXITSTATUS(status) != 0) {
    end.kind = EndApart::Kind::crashed;
    end.signal = signal;
  } else {
    end.result = result.read();
  }
  return end;
}

}  // namespace meshes
