// Memory of large arrays: it stays with the process, grows, is divided, and goes back when asked.
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <thread>

#include "fem/common/large_memory.h"
#include "fem/common/memory.h"

namespace {

constexpr std::size_t megabyte = 1u << 20;

fem::LargeVector<std::int64_t> counted(std::size_t bytes) {
  fem::LargeVector<std::int64_t> values(bytes / sizeof(std::int64_t));
  std::iota(values.begin(), values.end(), std::int64_t{0});
  return values;
}

bool is_counted(const fem::LargeVector<std::int64_t>& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] != std::int64_t(i)) return false;
  return true;
}

TEST(LargeMemory, IsKeptForTheNextArray) {
  fem::large_memory::release_kept();
  const void* place = nullptr;
  {
    const auto first = counted(64 * megabyte);
    place = first.data();
    EXPECT_EQ(fem::large_memory::bytes_kept(), 0u);
  }
  EXPECT_EQ(fem::large_memory::bytes_kept(), 64 * megabyte);
  {
    const auto second = counted(48 * megabyte);
    EXPECT_EQ(static_cast<const void*>(second.data()), place);
    EXPECT_EQ(fem::large_memory::bytes_kept(), 16 * megabyte);
    const auto third = counted(16 * megabyte);  // what is left of it
    EXPECT_EQ(fem::large_memory::bytes_kept(), 0u);
    EXPECT_TRUE(is_counted(second) && is_counted(third));
  }
  EXPECT_EQ(static_cast<const void*>(counted(64 * megabyte).data()), place);  // of both, joined
  fem::release_free_memory();
  EXPECT_EQ(fem::large_memory::bytes_kept(), 0u);
}

TEST(LargeMemory, Grows) {
  fem::large_memory::release_kept();
  for (const std::size_t megabytes : {32, 100, 101, 300}) {
    const auto values = counted(megabytes * megabyte);
    EXPECT_TRUE(is_counted(values)) << megabytes;
    EXPECT_EQ(fem::large_memory::bytes_kept(), 0u) << megabytes;
  }
  fem::large_memory::release_kept();
}

// A search or a sweep asks for arrays of ever other sizes, some beside others: pieces that fit none must not
// pile up.
TEST(LargeMemory, IsNeverMoreThanWasInUseAtOnce) {
  using namespace fem::large_memory;
  release_kept();
  std::mt19937 random(20261126);
  std::vector<std::pair<void*, std::size_t>> arrays;
  std::size_t in_use = 0, most = 0;
  for (int step = 0; step < 2000; ++step) {
    if (arrays.size() < 2 || (arrays.size() < 6 && random() % 2 == 0)) {
      const std::size_t bytes = 2 * megabyte * (8 + random() % 100);  // whole huge pages
      arrays.emplace_back(take(bytes), bytes);
      in_use += bytes;
      most = std::max(most, in_use);
    } else {
      const auto ended = arrays.begin() + random() % arrays.size();
      give_back(ended->first, ended->second);
      in_use -= ended->second;
      arrays.erase(ended);
    }
    ASSERT_LE(in_use + bytes_kept(), most) << step;
  }
  for (const auto& [memory, bytes] : arrays) give_back(memory, bytes);
  EXPECT_GT(bytes_kept(), most / 2);
  release_kept();
}

TEST(LargeMemory, OfSmallArraysIsNot) {
  fem::large_memory::release_kept();
  { const auto values = counted(fem::large_memory::least_bytes - sizeof(std::int64_t)); }
  EXPECT_EQ(fem::large_memory::bytes_kept(), 0u);
}

TEST(LargeMemory, ServesThreads) {
  fem::large_memory::release_kept();
  std::vector<std::thread> threads;
  std::vector<char> sound(4, 1);
  for (std::size_t t = 0; t < sound.size(); ++t)
    threads.emplace_back([&sound, t] {
      for (std::size_t i = 0; i < 20; ++i)
        if (!is_counted(counted((16 + 7 * ((i + t) % 5)) * megabyte))) sound[t] = 0;
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(sound, std::vector<char>(4, 1));
  fem::large_memory::release_kept();
}

TEST(LargeMemory, CopiesAsAVector) {
  const auto values = counted(20 * megabyte);
  auto copy = values;
  copy[5] = -1;
  EXPECT_TRUE(is_counted(values));
  copy.assign(copy.size(), 7);
  EXPECT_EQ(copy.front() + copy.back(), 14);
}

}  // namespace
