#include "pipelines/base/common/parallel.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "pipelines/judge/estimates/in_time.h"

namespace {

using std::chrono::milliseconds;

// Of several failures the first in time depends on how threads are scheduled: the second item fails before
// the first one does.
TEST(ParallelWork, FailsByItsFirstItem) {
  std::atomic<bool> second_fails{false};
  std::string message;
  try {
    pipelines::for_each_parallel(8, 2, [&](std::size_t, std::size_t i) {
      if (i == 0) {
        for (int wait = 0; wait < 5000 && !second_fails; ++wait) std::this_thread::sleep_for(milliseconds(1));
        std::this_thread::sleep_for(milliseconds(50));  // until that failure was caught
        throw std::runtime_error("item 0");
      }
      second_fails = true;
      throw std::runtime_error("item " + std::to_string(i));
    });
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_TRUE(second_fails);
  EXPECT_EQ(message, "item 0");
}

/// Threads cannot be started while it lives: no machine has memory for their stacks.
class NoMoreThreads {
public:
  NoMoreThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t huge;
    pthread_attr_init(&huge);
    pthread_attr_setstacksize(&huge, std::size_t(1) << 52);
    pthread_setattr_default_np(&huge);
    pthread_attr_destroy(&huge);
  }
  ~NoMoreThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }
  NoMoreThreads(const NoMoreThreads&) = delete;
  NoMoreThreads& operator=(const NoMoreThreads&) = delete;

private:
  pthread_attr_t before_{};
};

TEST(ParallelWork, IsDoneByTheCallerWhereNoThreadStarts) {
  const NoMoreThreads none;
  EXPECT_THROW(std::thread([] {}).join(), std::system_error);
  std::vector<int> times_done(100, 0);
  pipelines::for_each_parallel(100, 4, [&](std::size_t worker, std::size_t i) {
    EXPECT_EQ(worker, 0u);
    ++times_done[i];
  });
  EXPECT_EQ(times_done, std::vector<int>(100, 1));
}

// Work that asks for the time ends when it is up, and what else it throws passes through. Red where an item
// is begun whatever the time: a thousand of them take ten seconds on two threads.
TEST(ParallelWork, EndsWhenTheTimeIsUp) {
  std::atomic<int> n_done{0};
  const auto work = [&](std::size_t, std::size_t) {
    std::this_thread::sleep_for(milliseconds(20));
    ++n_done;
  };
  EXPECT_FALSE(pipelines::in_time(0.05, [&] { pipelines::for_each_parallel(1000, 2, work); }));
  EXPECT_LT(n_done, 900);
  n_done = 0;
  EXPECT_TRUE(pipelines::in_time(1000, [&] { pipelines::for_each_parallel(3, 2, work); }));
  EXPECT_TRUE(pipelines::in_time(std::numeric_limits<double>::infinity(),
                                 [&] { pipelines::for_each_parallel(3, 2, work); }));
  EXPECT_EQ(n_done, 6);
  EXPECT_THROW(pipelines::in_time(1000, [] { throw std::runtime_error("another matter"); }),
               std::runtime_error);
}

}  // namespace
