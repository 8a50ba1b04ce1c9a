#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pipelines/base/files/json_file.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/write/files/manifest.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;

namespace {

bool is_read(const results_test::Directory& at, const std::string& text) {
  std::ofstream(at / "file.json", std::ios::binary) << text;
  return !read_json_file(at / "file.json").is_discarded();
}

std::string nested_lists(std::size_t levels) {
  return std::string(levels, '[') + std::string(levels, ']');
}

TEST(JsonFile, IsReadOrDiscarded) {
  const results_test::Directory at;
  EXPECT_TRUE(read_json_file(at / "none.json").is_discarded());
  EXPECT_TRUE(read_json_file(at.path).is_discarded());
  EXPECT_FALSE(is_read(at, ""));
  EXPECT_FALSE(is_read(at, "{\"a\": 1"));
  EXPECT_TRUE(is_read(at, "{\"a\": [1, {\"b\": null}]}"));
}

TEST(JsonFile, IsNotReadBelowAHundredLevels) {
  const results_test::Directory at;
  EXPECT_TRUE(is_read(at, nested_lists(100)));
  EXPECT_FALSE(is_read(at, nested_lists(101)));
  EXPECT_TRUE(is_read(at, "[\"\\\"" + std::string(1000, '[') + "\"]"));
}

// The library writes and compares by recursion: such files ended the program by a signal.
TEST(JsonFile, OfManyBracketsIsDamaged) {
  const results_test::Directory at;
  const std::string deep = nested_lists(200'000);
  std::ofstream(at / manifest_name) << "{\"files\": {\"a\": " + deep + "}, \"checksum\": \"\"}";
  EXPECT_TRUE(check_manifest(at.path).damaged);
}

/// A file of so many zeros, of which none is on the disk.
void make_sparse(const std::filesystem::path& file, std::uintmax_t n_bytes) {
  std::ofstream(file, std::ios::binary) << "{";
  std::filesystem::resize_file(file, n_bytes);
}

// 8 GB were read into memory, byte by byte.
TEST(JsonFile, OfGigabytesIsNotRead) {
  const results_test::Directory at;
  const auto begin = std::chrono::steady_clock::now();
  for (const char* name : {"file.json", "manifest.json"}) make_sparse(at / name, 8'000'000'000);
  EXPECT_TRUE(read_json_file(at / "file.json").is_discarded());
  EXPECT_TRUE(check_manifest(at.path).damaged);
  // To read one takes ten seconds and more.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

TEST(WholeFile, IsReadUpToASize) {
  const results_test::Directory at;
  std::ofstream(at / "text") << "12345";
  EXPECT_EQ(whole_file(at / "text", 5), "12345");
  EXPECT_EQ(whole_file(at / "text", 4), std::nullopt);
  EXPECT_EQ(whole_file(at / "none"), std::nullopt);
  EXPECT_EQ(whole_file(at.path), std::nullopt);
  std::ofstream(at / "empty").flush();
  EXPECT_EQ(whole_file(at / "empty"), "");
  EXPECT_EQ(size_text(8'000'000'000), "8.0 GB");
  EXPECT_EQ(size_text(2'500'000), "2.5 MB");
  EXPECT_EQ(size_text(500'000'000), "500 MB");
}

}  // namespace
