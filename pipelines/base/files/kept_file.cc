#include "pipelines/base/files/kept_file.h"

#include <fstream>
#include <string>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/content_hash.h"

namespace pipelines {
namespace {

constexpr std::size_t n_digits = 32;
const std::string key_title = "\nmillstress key ", content_title = " content ";

std::string start_of_line(std::string_view key_hash) {
  return key_title + std::string(key_hash) + content_title;
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
    if (!out) throw FileError(shown(file) + ": cannot be written; check the directory and the free space");
  };
  append(start_of_line(text_hash(key)));
  append(content_hash(file) + "\n");
}

KeptFile check_kept_file(const std::filesystem::path& file, std::string_view key) {
  return check_kept_file_of(file, text_hash(key));
}

KeptFile checked_on_first_rank(const std::filesystem::path& file, std::string_view key) {
  return KeptFile(as_on_first_rank(is_first_rank() ? int(check_kept_file(file, key)) : 0));
}

KeptFile check_kept_file_of(const std::filesystem::path& file, std::string_view key_hash) {
  std::error_code none;
  const auto status = std::filesystem::status(file, none);
  if (status.type() == std::filesystem::file_type::not_found) return KeptFile::missing;
  if (status.type() != std::filesystem::file_type::regular) return KeptFile::damaged;
  const std::size_t start = key_title.size() + n_digits + content_title.size(), line = start + n_digits + 1;
  const auto size = std::filesystem::file_size(file, none);
  if (none || size < line) return KeptFile::damaged;
  const auto end = read_end(file, size, line);
  if (end.compare(0, key_title.size(), key_title) != 0 ||
      end.compare(key_title.size() + n_digits, content_title.size(), content_title) != 0 ||
      end.back() != '\n')
    return KeptFile::damaged;
  if (!key_hash.empty() && end.compare(0, start, start_of_line(key_hash)) != 0) return KeptFile::other_key;
  try {
    return content_hash(file, size - n_digits - 1) == end.substr(start, n_digits) ? KeptFile::whole
                                                                                  : KeptFile::damaged;
  } catch (const FileError&) {  // unreadable, or cut meanwhile
    return KeptFile::damaged;
  }
}

std::string damaged_file_text(const std::filesystem::path& file) {
  return shown(file) +
         ": is damaged, or not of this version of the program; nothing of it was used, and it is made anew";
}

}  // namespace pipelines
