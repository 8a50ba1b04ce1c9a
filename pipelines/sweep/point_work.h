/// Work on many points: what ends one of them and what ends the sweep; several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "pipelines/common/errors.h"
#include "pipelines/common/failure.h"

namespace pipelines {

/// What a point's own numbers may be refused for becomes its row; a disk that is full and errors of the
/// program end the sweep.
/// @return why work() was refused; empty if it was not
template <typename Work>
std::string point_refusal(const Work& work) {
  try {
    work();
    return {};
  } catch (const FileError&) {
    throw;
  } catch (const std::filesystem::filesystem_error&) {
    throw;
  } catch (...) {
    auto failure = failure_in_flight();
    if (failure.message.find("internal error") != std::string::npos) throw;
    return std::move(failure.message);
  }
}

/// Calls work(worker, i) for all i below n on several threads.
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
  std::vector<std::thread> threads;
  for (int t = 0; t < n_threads; ++t) threads.emplace_back(run, std::size_t(t));
  for (auto& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace pipelines
