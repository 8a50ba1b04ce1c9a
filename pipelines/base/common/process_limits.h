/// Limits that the process was started with, at which libraries would end it without a reason. And signals
/// that ask it to end (SIGINT, SIGTERM, SIGHUP, SIGXCPU): they end it at once, so that no destructor runs
/// beside threads that still work. What is only half done then is under a name of its own. Where several
/// names change together, the signal waits for the last of them.
#pragma once

#include <atomic>
#include <csignal>
#include <string>

namespace pipelines {

/// Lets the stack grow as it usually may (8 MB), on threads to come too, where the hard limit allows it.
/// To be called before other threads are started.
/// @throws OptionError naming limit, value and remedy: less than 1 MB of stack, in which drawing ends by a
///   signal
void require_usable_stack();

/// Whether memory of this process is limited. Then a thread of OpenBLAS that got none asks for it until it
/// does, and a process that ends in the usual way waits for that thread.
bool memory_is_limited();

/// Whether a limited process may still have what a picture takes: the compiler of its shaders aborts without.
bool has_memory_to_draw();

/// Why there is no picture on this machine, or of this process.
std::string why_nothing_draws();

namespace interruption {

// Read and written by a signal handler: no lock may be behind them.
static_assert(std::atomic<int>::is_always_lock_free);
inline std::atomic<int> n_uninterrupted{0};
inline std::atomic<int> waiting_signal{0};  ///< 0: none
/// Whether who started the program ignores that the reader of its output goes away.
inline std::atomic<bool> closed_pipes_are_ignored{false};

}  // namespace interruption

/// As long as one lives, on any thread, a signal that asks the program to end waits.
class Uninterrupted {
public:
  Uninterrupted() { ++interruption::n_uninterrupted; }
  ~Uninterrupted() {
    if (--interruption::n_uninterrupted > 0) return;
    if (const int signal = interruption::waiting_signal; signal != 0) std::raise(signal);
  }
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
};

}  // namespace pipelines
