/// What has to be looked at before libraries are initialised, where nothing of them may be used but system
/// calls: deal.II reads DEAL_II_NUM_THREADS then and aborts where that is no number from 1; Open MPI and
/// OpenBLAS end a process that has few files or little memory with texts of their own; and a file that is
/// opened while stdout is closed becomes stdout.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstddef>

#include "pipelines/base/common/failure.h"
#include "pipelines/base/common/process_limits.h"

namespace {

void tell(const char* text) {
  std::size_t length = 0;
  while (text[length] != 0) ++length;
  if (write(STDERR_FILENO, text, length) < 0) return;  // then the exit code alone tells
}

void tell(unsigned long number) {
  char digits[24];
  char* at = digits + sizeof digits;
  *--at = 0;
  do *--at = char('0' + number % 10);
  while ((number /= 10) > 0);
  tell(at);
}

/// A stream that is closed is opened so that its use fails as if it were closed: stdout for reading alone.
void hold_standard_streams() {
  for (int stream = 0; stream < 3; ++stream)
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

constexpr char thread_variable[] = "DEAL_II_NUM_THREADS=";

/// The variable's value; null: not set.
const char* thread_variable_in(char** environment) {
  for (; *environment != nullptr; ++environment) {
    std::size_t i = 0;
    while (thread_variable[i] != 0 && (*environment)[i] == thread_variable[i]) ++i;
    if (thread_variable[i] == 0) return *environment + i;
  }
  return nullptr;
}

bool is_number_from_1(const char* text) {
  constexpr int most_digits = 9;  // fits into an int
  int n_digits = 0, n = 0;
  for (; *text >= '0' && *text <= '9' && n_digits < most_digits; ++text, ++n_digits) n = 10 * n + *text - '0';
  return *text == 0 && n >= 1;
}

void refuse_wrong_thread_variable(char** environment) {
  const char* const value = thread_variable_in(environment);
  if (value == nullptr || is_number_from_1(value)) return;
  tell("millstress: DEAL_II_NUM_THREADS = \"");
  tell(value);
  tell(
      "\" in the environment: must be the most threads to use, a whole number from 1; write one, or unset "
      "it\n");
  _exit(pipelines::scene_is_wrong);
}

/// Open MPI fails with 10, and files cannot be written with 12; 16 suffice for a shaft with pictures on two
/// threads.
constexpr rlim_t least_files = 32, usual_files = 1024;
/// Libraries are loaded with 550 MB of addresses, and their threads wait for memory for ever with 600.
constexpr rlim_t least_address_space = rlim_t{768} << 20;

void refuse_few_files() {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0 || files.rlim_cur >= usual_files) return;
  files.rlim_cur = std::min(files.rlim_max, usual_files);
  setrlimit(RLIMIT_NOFILE, &files);
  if (files.rlim_cur >= least_files) return;
  tell("millstress: this process may have ");
  tell(files.rlim_cur);
  tell(" files open (ulimit -n), and ");
  tell(least_files);
  tell(" are needed: raise that limit; 1024 are usual\n");
  _exit(pipelines::scene_is_wrong);
}

void refuse_little_address_space() {
  rlimit space{};
  if (getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur >= least_address_space) return;
  tell("millstress: this process may have ");
  tell(space.rlim_cur >> 20);
  tell(" MB of memory (ulimit -v), and ");
  tell(least_address_space >> 20);
  tell(" are needed to begin with: raise that limit\n");
  _exit(pipelines::mesh_or_solve_failed);
}

struct EndingSignal {
  int number;
  const char* name;
};
constexpr EndingSignal ending_signals[] = {{SIGINT, "SIGINT"},
                                           {SIGTERM, "SIGTERM"},
                                           {SIGHUP, "SIGHUP"},
                                           {SIGXCPU, "SIGXCPU, the limit of processor time (ulimit -t)"}};

bool tells_of_signals = true;

/// Ends the process by the signal itself, at once: what destructors would do is not safe here, and not
/// needed.
void end_by(int number) {
  pipelines::interruption::waiting_signal = number;
  if (pipelines::interruption::n_uninterrupted > 0) return;  // the last of them raises it again
  for (const auto& signal : ending_signals)
    if (signal.number == number && tells_of_signals) {
      tell("millstress: ended by ");
      tell(signal.name);
      tell("; results are those of before, or all new if they were complete\n");
    }
  struct sigaction by_default {};
  by_default.sa_handler = SIG_DFL;
  sigaction(number, &by_default, nullptr);
  raise(number);
}

/// What who started the program ignores (nohup) stays ignored. Writing beyond a limit of size (ulimit -f) or
/// to a pipe that nobody reads shall fail as any write does.
void prepare_signals() {
  struct sigaction known {};
  for (const auto& signal : ending_signals) {
    if (sigaction(signal.number, nullptr, &known) != 0 || known.sa_handler == SIG_IGN) continue;
    struct sigaction ending {};
    ending.sa_handler = end_by;
    ending.sa_flags = SA_NODEFER | SA_RESTART;
    sigaction(signal.number, &ending, nullptr);
  }
  struct sigaction ignored {};
  ignored.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &ignored, nullptr);
  sigaction(SIGPIPE, &ignored, &known);
  pipelines::interruption::closed_pipes_are_ignored = known.sa_handler == SIG_IGN;
}

/// A launcher of ranks tells by itself how they ended, and ends them all by a signal when one fails.
bool is_a_rank(char** environment) {
  for (; *environment != nullptr; ++environment)
    for (const char* name : {"OMPI_COMM_WORLD_RANK=", "PMI_RANK="}) {
      std::size_t i = 0;
      while (name[i] != 0 && (*environment)[i] == name[i]) ++i;
      if (name[i] == 0) return true;
    }
  return false;
}

void prepare_process(int /*argc*/, char** /*argv*/, char** environment) {
  hold_standard_streams();
  refuse_wrong_thread_variable(environment);
  refuse_few_files();
  refuse_little_address_space();
  tells_of_signals = !is_a_rank(environment);
  prepare_signals();
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)(int, char**,
                                                                             char**) = prepare_process;

}  // namespace
