#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/kept_file.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::bytes;
using results_test::Directory;

namespace {

void write_kept(const std::filesystem::path& file, const std::string& text, const std::string& key) {
  std::ofstream(file, std::ios::binary) << text;
  append_checksum(file, key);
}

// Reference values of the hash function's own program: printf '' | xxhsum -H2, printf abc | xxhsum -H2.
TEST(ContentHash, IsThatOfXxhsum) {
  EXPECT_EQ(text_hash(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(text_hash("abc"), "06b05ab6733a618578af5f94892f3950");
  const Directory at;
  std::ofstream(at / "abc") << "abcdef";
  EXPECT_EQ(content_hash(at / "abc", 3), text_hash("abc"));
  EXPECT_EQ(content_hash(at / "abc"), text_hash("abcdef"));
}

TEST(KeptFile, IsBelievedUnderItsKeyAlone) {
  const Directory at;
  EXPECT_EQ(check_kept_file(at / "a", "key"), KeptFile::missing);
  write_kept(at / "a", "content", "key");
  EXPECT_EQ(check_kept_file(at / "a", "key"), KeptFile::whole);
  EXPECT_EQ(check_kept_file(at / "a", "another key"), KeptFile::other_key);
  EXPECT_EQ(bytes(at / "a").rfind("content", 0), 0u);
  EXPECT_EQ(check_kept_file(at.path, "key"), KeptFile::damaged);
  write_kept(at / "empty", "", "");
  EXPECT_EQ(check_kept_file(at / "empty", ""), KeptFile::whole);
  std::ofstream(at / "foreign") << std::string(500, 'x');
  EXPECT_EQ(check_kept_file(at / "foreign", "key"), KeptFile::damaged);
}

TEST(KeptFile, IsWholeForWhoKnowsTheHashOfTheKeyAlone) {
  const Directory at;
  EXPECT_EQ(check_kept_file_of(at / "a", ""), KeptFile::missing);
  write_kept(at / "a", "content", "key");
  EXPECT_EQ(check_kept_file_of(at / "a", text_hash("key")), KeptFile::whole);
  EXPECT_EQ(check_kept_file_of(at / "a", text_hash("another key")), KeptFile::other_key);
  EXPECT_EQ(check_kept_file_of(at / "a", ""), KeptFile::whole) << "any key";
  auto changed = bytes(at / "a");
  changed[2] = 'x';
  std::ofstream(at / "a", std::ios::binary) << changed;
  EXPECT_EQ(check_kept_file_of(at / "a", ""), KeptFile::damaged);
  EXPECT_EQ(check_kept_file_of(at / "a", text_hash("key")), KeptFile::damaged);
}

// A bit of every byte, every length, and bytes behind. Only within the hash of the key a flip
// makes it a file of another key, which is not believed either.
TEST(KeptFile, NoChangedBitAndNoLengthIsBelieved) {
  const Directory at;
  std::mt19937 random(3);
  std::string text(40, '\0');
  for (char& c : text) c = char(random());
  write_kept(at / "whole", text, "key");
  const auto whole = bytes(at / "whole");
  const auto state_of = [&](const std::string& content) {
    std::ofstream(at / "changed", std::ios::binary) << content;
    return check_kept_file(at / "changed", "key");
  };
  int n_other_key = 0;
  for (std::size_t place = 0; place < whole.size(); ++place) {
    auto changed = whole;
    changed[place] = char(changed[place] ^ (1 << place % 8));
    const auto state = state_of(changed);
    EXPECT_TRUE(state == KeptFile::damaged || state == KeptFile::other_key) << place;
    n_other_key += state == KeptFile::other_key ? 1 : 0;
  }
  EXPECT_EQ(n_other_key, 32);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(state_of(whole.substr(0, size)), KeptFile::damaged) << size;
  EXPECT_EQ(state_of(whole + "\n"), KeptFile::damaged);
  EXPECT_EQ(state_of(whole + whole), KeptFile::damaged);
  EXPECT_EQ(state_of(whole), KeptFile::whole);
}

}  // namespace
