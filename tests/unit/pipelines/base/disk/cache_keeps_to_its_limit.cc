/// The user's cache: where it is, what goes first, and that files of others stay.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/cache.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace {

using namespace pipelines;
namespace fs = std::filesystem;

std::string name_of(char digit) {
  return std::string(32, digit);
}

/// @param used_s  when it was used last
void put(const fs::path& file, std::size_t bytes, long used_s) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << std::string(bytes, 'x');
  const timespec times[2] = {{used_s, 0}, {0, UTIME_OMIT}};
  ASSERT_EQ(utimensat(AT_FDCWD, file.c_str(), times, 0), 0);
}

class Cache : public testing::Test {
protected:
  void SetUp() override {
    setenv("XDG_CACHE_HOME", directory_.path.c_str(), 1);
    unsetenv("MILLSTRESS_CACHE_LIMIT");
  }
  void TearDown() override { unsetenv("MILLSTRESS_CACHE_LIMIT"); }
  const results_test::Directory directory_;
};

TEST_F(Cache, IsWhereTheSpecificationOfTheDesktopHasIt) {
  EXPECT_EQ(cache_directory(), directory_ / "millstress");
  const char* const home = std::getenv("HOME");
  const std::string before = home == nullptr ? "/root" : home;
  setenv("HOME", "/home/somebody", 1);
  setenv("XDG_CACHE_HOME", "relative", 1);  // "must be ignored"
  EXPECT_EQ(cached_file(name_of('a')), "/home/somebody/.cache/millstress/" + name_of('a') + ".h5");
  unsetenv("HOME");
  EXPECT_THROW(cache_directory(), FileError);
  setenv("HOME", before.c_str(), 1);
}

TEST_F(Cache, WhatWasUsedLongestAgoGoesFirst) {
  const auto a = cached_file(name_of('a')), b = cached_file(name_of('b')), c = cached_file(name_of('c'));
  put(a, 100, 3000);
  put(b, 100, 1000);
  put(c, 100, 2000);
  put(directory_ / "millstress/notes.txt", 100, 1);
  put(directory_ / "millstress/../others.h5", 100, 1);
  fs::create_symlink("../others.h5", cached_file(name_of('d')));
  mark_used(b);
  keep_cache_within(250);
  EXPECT_TRUE(fs::exists(a));
  EXPECT_TRUE(fs::exists(b)) << "used just now";
  EXPECT_FALSE(fs::exists(c));
  keep_cache_within(199);
  EXPECT_FALSE(fs::exists(a));
  EXPECT_EQ(cached_files().size(), 1u);
  keep_cache_within(0);
  EXPECT_TRUE(cached_files().empty());
  EXPECT_TRUE(fs::exists(directory_ / "millstress/notes.txt"));
  EXPECT_TRUE(fs::exists(directory_ / "others.h5"));
}

TEST_F(Cache, ItsLimitIsANumberOfGigabytes) {
  EXPECT_EQ(cache_limit(), 5'000'000'000u);
  setenv("MILLSTRESS_CACHE_LIMIT", "0.5", 1);
  EXPECT_EQ(cache_limit(), 500'000'000u);
  for (const char* wrong : {"-1", "5 GB", "much", "nan", "1e99"}) {
    setenv("MILLSTRESS_CACHE_LIMIT", wrong, 1);
    EXPECT_THROW(cache_limit(), FileError) << wrong;
  }
}

}  // namespace
