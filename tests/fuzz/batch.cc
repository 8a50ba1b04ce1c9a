#include "tests/fuzz/batch.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <stdexcept>

#include "tests/fuzz/child.h"

// Of the sanitizer for addresses; null without it.
// NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" __attribute__((weak)) int __lsan_do_recoverable_leak_check();

namespace fuzz {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;  // their shadows map terabytes
#else
constexpr bool is_sanitized = false;
#endif

/// What a worker tells the process that counts, also if it ends by a signal.
struct Shared {
  int current = 0;
  bool between_cases = false;
  Tally tally;
};

class SharedMemory {
public:
  SharedMemory()
      : memory_(::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::runtime_error("no memory to share with workers");
    new (memory_) Shared;
  }
  ~SharedMemory() { ::munmap(memory_, sizeof(Shared)); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  Shared* operator->() const { return static_cast<Shared*>(memory_); }

private:
  void* memory_;
};

/// Each case has a generator of its own (FNV-1a of what names it).
std::uint64_t seed_of(const std::string& kind, std::uint64_t seed, int number) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : kind + ' ' + std::to_string(seed) + ' ' + std::to_string(number))
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

void empty(const fs::path& directory) {
  fs::remove_all(directory);
  fs::create_directories(directory);
}

/// Keeps the case's files and says how to run it again.
void tell(const Kind& kind, const Batch& batch, const Place& place, int number, const std::string& fault) {
  const auto name = kind.name + "_" + std::to_string(batch.seed) + "_" + std::to_string(number);
  std::error_code none;
  fs::remove_all(batch.kept / name, none);
  fs::create_directories(batch.kept, none);
  fs::copy(place.directory, batch.kept / name, fs::copy_options::recursive, none);
  std::fprintf(stderr, "FAULT in fuzz --kind %s --seed %llu --case %d, kept in %s\n  %.2000s\n",
               kind.name.c_str(), static_cast<unsigned long long>(batch.seed), number,
               (batch.kept / name).c_str(), fault.c_str());
}

/// A count that asks for more memory than there is shows as std::bad_alloc, which is a fault.
void limit_memory() {
  if (is_sanitized) return;
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  constexpr double most_bytes = 4e9;
  rlimit limit{};
  ::getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min(limit.rlim_max, rlim_t(pages * double(::sysconf(_SC_PAGE_SIZE)) + most_bytes));
  ::setrlimit(RLIMIT_AS, &limit);
}

void run_case(const Kind& kind, const Batch& batch, const Place& place, int number, Tally& tally) {
  empty(place.directory);
  limit_this_process(batch.seconds_of_core + 1, 20 * batch.seconds_of_core);
  Mutator random(seed_of(kind.name, batch.seed, number));
  const double before_s = seconds_used();
  Verdict verdict;
  try {
    verdict = kind.run(random, place);
  } catch (const std::exception& error) {
    verdict.fault = std::string("the case itself fails: ") + error.what();
  }
  const double took_s = seconds_used() - before_s;
  if (verdict.fault.empty() && took_s > batch.seconds_of_core)
    verdict.fault = "takes " + std::to_string(took_s) + " s of a core";
  ++tally.n_cases;
  ++(!verdict.fault.empty() ? tally.n_faults : verdict.accepted ? tally.n_accepted : tally.n_refused);
  if (took_s > tally.slowest_s) {
    tally.slowest_s = took_s;
    tally.slowest_case = number;
  }
  if (batch.talkative)
    std::fprintf(stderr, "%s %d: %s: %s, %.2f s\n", kind.name.c_str(), number, random.deeds().c_str(),
                 verdict.accepted ? "accepted" : "refused", took_s);
  if (!verdict.fault.empty())
    tell(kind, batch, place, number, verdict.fault + "\n  after: " + random.deeds());
}

[[noreturn]] void be_the_worker(const Kind& kind, const Batch& batch, const Place& place, int next,
                                SharedMemory& shared) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL})
    if (!is_sanitized) std::signal(signal, SIG_DFL);
  limit_memory();
  for (; next < batch.first + batch.n_cases; ++next) {
    shared->current = next;
    run_case(kind, batch, place, next, shared->tally);
  }
  shared->between_cases = true;
  const bool leaks = __lsan_do_recoverable_leak_check != nullptr && __lsan_do_recoverable_leak_check() != 0;
  ::_exit(leaks ? 1 : 0);
}

std::string told(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU || signal == SIGALRM) return "did not come to an end";
    return "ended by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
  }
  return "ended the process with exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

void Tally::add(const Tally& other) {
  n_cases += other.n_cases;
  n_accepted += other.n_accepted;
  n_refused += other.n_refused;
  n_faults += other.n_faults;
  if (other.slowest_s > slowest_s) {
    slowest_s = other.slowest_s;
    slowest_case = other.slowest_case;
  }
}

Tally run_batch(const Kind& kind, const Batch& batch, const Place& place) {
  SharedMemory shared;
  for (int next = batch.first; next < batch.first + batch.n_cases; next = shared->current + 1) {
    std::fflush(nullptr);
    const pid_t worker = ::fork();
    if (worker < 0) throw std::runtime_error("no process can be started");
    if (worker == 0) be_the_worker(kind, batch, place, next, shared);
    int status = 0;
    while (::waitpid(worker, &status, 0) < 0 && errno == EINTR) {
    }
    if (status == 0) break;
    if (shared->between_cases) {
      ++shared->tally.n_faults;
      std::fprintf(stderr, "FAULT in %s, cases %d to %d: memory is lost, or the worker %s\n",
                   kind.name.c_str(), batch.first, batch.first + batch.n_cases - 1, told(status).c_str());
      break;
    }
    ++shared->tally.n_cases;
    ++shared->tally.n_faults;
    tell(kind, batch, place, shared->current, told(status));
  }
  return shared->tally;
}

}  // namespace fuzz
