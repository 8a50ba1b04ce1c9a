/// Loops over independent items on the threads that Environment has set.
#pragma once

#include <cstddef>
#include <functional>

namespace fem {

/// Calls body(begin, end) for disjoint ranges that cover 0..n, on several threads.
/// @param grain  smallest range worth a task of its own
/// The ranges depend on the machine; results do not as long as no item writes what another one reads or
/// writes.
/// @throws OutOfTime (deadline.h) before a range once the time is up, and what the body throws
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// While it lives, BLAS calls stay on the calling thread: for calls from inside parallel_for.
class SerialBlas {
public:
  SerialBlas();
  ~SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;

private:
  int n_threads_before_;
};

/// While it lives, OpenMP loops that the calling thread comes to stay on it. CHOLMOD hands each of its many
/// short loops to four threads, however few the cores: waking them costs more than they do.
class SerialOpenMp {
public:
  SerialOpenMp();
  ~SerialOpenMp();
  SerialOpenMp(const SerialOpenMp&) = delete;
  SerialOpenMp& operator=(const SerialOpenMp&) = delete;

private:
  int levels_before_;
};

/// Threads of OpenBLAS; nothing happens with another BLAS.
void set_blas_threads(int n_threads);

}  // namespace fem
