#include "pipelines/files/kept_file.h"

#include <fstream>
#include <string>

#include "pipelines/common/errors.h"
#include "pipelines/files/content_hash.h"

namespace pipelines {
namespace {

constexpr std::size_t n_digits = 32;
const std::string key_title = "\nmillstress key ", content_title = " content ";

std::string start_of_line(std::string_view key) {
  return key_title + text_hash(key) + content_title;
}

std::string read_end(const std::filesystem::path& file, std::uintmax_t size, std::size_t n_bytes) {
  std::string text(n_bytes, '\0');
  std::ifstream in(file, std::ios::binary);
  in.seekg(std::streamoff(size - n_bytes));
  in.read(text.data(), std::streamsize(n_bytes));
  return in ? text : std::string();
}

}  // namespace

void append_checksum(const std::filesystem::path& file, std::string_view key) {
  const auto append = [&](const std::string& text) {
    std::ofstream out(file, std::ios::binary | std::ios::app);
    out << text;
    out.close();
    if (!out) throw FileError(file.string() + ": cannot be written; check the directory and the free space");
  };
  append(start_of_line(key));
  append(content_hash(file) + "\n");
}

KeptFile check_kept_file(const std::filesystem::path& file, std::string_view key) {
  std::error_code none;
  const auto status = std::filesystem::status(file, none);
  if (status.type() == std::filesystem::file_type::not_found) return KeptFile::missing;
  if (status.type() != std::filesystem::file_type::regular) return KeptFile::damaged;
  const auto expected = start_of_line(key);
  const std::size_t line = expected.size() + n_digits + 1;
  const auto size = std::filesystem::file_size(file, none);
  if (none || size < line) return KeptFile::damaged;
  const auto end = read_end(file, size, line);
  if (end.compare(0, key_title.size(), key_title) != 0 ||
      end.compare(key_title.size() + n_digits, content_title.size(), content_title) != 0 ||
      end.back() != '\n')
    return KeptFile::damaged;
  if (end.compare(0, expected.size(), expected) != 0) return KeptFile::other_key;
  try {
    return content_hash(file, size - n_digits - 1) == end.substr(expected.size(), n_digits)
               ? KeptFile::whole
               : KeptFile::damaged;
  } catch (const FileError&) {  // unreadable, or cut meanwhile
    return KeptFile::damaged;
  }
}

std::string damaged_file_text(const std::filesystem::path& file) {
  return file.string() +
         ": is damaged, or not of this version of the program; nothing of it was used, and it is made anew";
}

}  // namespace pipelines
