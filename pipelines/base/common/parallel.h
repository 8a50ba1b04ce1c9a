/// Work dealt out to several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "fem/base/common/deadline.h"

namespace pipelines {

/// Calls work(worker, i) for all i below n, on the caller's thread as worker 0 and on others, as many of them
/// as the system starts. What a worker throws ends its own work; once all others have ended, that of the
/// smallest i is thrown.
/// @param n_threads  at most, with the caller's
/// @throws fem::OutOfTime before an item once the time is up
template <typename Work>
void for_each_parallel(std::size_t n, int n_threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::size_t failed = n;
  std::mutex failing;
  // Every i below one that was begun was begun too, so that the smallest one that fails is always met.
  const auto run = [&](std::size_t worker) {
    std::size_t i = 0;
    try {
      for (i = next++; i < n; i = next++) {
        fem::require_time();
        work(worker, i);
      }
    } catch (...) {
      const std::lock_guard lock(failing);
      if (i < failed) failure = std::current_exception();
      failed = std::min(failed, i);
    }
  };
  const std::size_t n_workers = std::min(n, std::size_t(std::max(1, n_threads)));
  std::vector<std::thread> threads;
  threads.reserve(n_workers);
  try {
    for (std::size_t worker = 1; worker < n_workers; ++worker) threads.emplace_back(run, worker);
  } catch (const std::exception&) {  // no more threads, or no memory for one: those that run do the work
  }
  run(0);
  for (auto& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

/// Calls work(begin, end) for ranges that together are all below n.
/// @param at_once  size of the ranges, but for the last
template <typename Work>
void for_each_range(std::size_t n, std::size_t at_once, int n_threads, const Work& work) {
  for_each_parallel((n + at_once - 1) / at_once, n_threads, [&](std::size_t, std::size_t range) {
    work(range * at_once, std::min(n, (range + 1) * at_once));
  });
}

}  // namespace pipelines
