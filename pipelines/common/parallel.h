/// Work dealt out to several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace pipelines {

/// Calls work(worker, i) for all i below n, on the caller's thread as worker 0 and on others. What a worker
/// throws ends its own work and is thrown once all others have ended.
template <typename Work>
void for_each_parallel(std::size_t n, int n_threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto run = [&](std::size_t worker) {
    try {
      for (std::size_t i = next++; i < n; i = next++) work(worker, i);
    } catch (...) {
      const std::lock_guard lock(failing);
      if (!failure) failure = std::current_exception();
    }
  };
  const std::size_t n_workers = std::min(n, std::size_t(std::max(1, n_threads)));
  std::vector<std::thread> threads;
  for (std::size_t worker = 1; worker < n_workers; ++worker) threads.emplace_back(run, worker);
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
