/// Files that are read as a whole, up to a size: a file may claim terabytes and have hardly a byte on the
/// disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace pipelines {

/// More than any file that this program writes for itself to read again, or that it takes into a page.
constexpr std::uintmax_t most_bytes_of_a_result = 500'000'000;
/// A table's numbers take as much memory as its text, and are read at 50 MB/s.
constexpr std::uintmax_t most_bytes_of_a_table = 500'000'000;

/// A size for people: "8.0 GB", "12 MB".
inline std::string size_text(std::uintmax_t bytes) {
  const bool gigabytes = bytes >= 1'000'000'000;
  const auto tenths = bytes / (gigabytes ? 100'000'000 : 100'000);
  return std::to_string(tenths / 10) + (tenths < 1000 ? "." + std::to_string(tenths % 10) : "") +
         (gigabytes ? " GB" : " MB");
}

/// 0 where there is none.
inline std::uintmax_t size_of_file(const std::filesystem::path& file) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  return none ? 0 : size;
}

/// @return its bytes; nothing if it is no regular file, cannot be read, or has more than `most_bytes`
inline std::optional<std::string> whole_file(const std::filesystem::path& file,
                                             std::uintmax_t most_bytes = most_bytes_of_a_result) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return std::nullopt;  // a stream on a directory throws
  std::ifstream in(file, std::ios::binary);
  const auto size = size_of_file(file);
  if (!in || size > most_bytes) return std::nullopt;
  std::string text(size, '\0');
  in.read(text.data(), std::streamsize(size));
  if (in.bad() || std::uintmax_t(in.gcount()) != size) return std::nullopt;  // cut meanwhile
  return text;
}

/// @return the first line without its end; empty if it has more than 1000 bytes, or the file cannot be read
inline std::string first_line(const std::filesystem::path& file) {
  constexpr std::size_t longest = 1000;
  std::string bytes(longest + 1, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), std::streamsize(bytes.size()));
  bytes.resize(std::size_t(in.gcount()));
  const auto end = bytes.find('\n');
  return end == std::string::npos && bytes.size() > longest ? "" : bytes.substr(0, end);
}

}  // namespace pipelines
