/// Hashes of content: of what a result depends on, and to find damage in files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace pipelines {

/// 128-bit hash (XXH3) of a file's content in 32 hexadecimal digits. @throws FileError if it cannot be read
std::string content_hash(const std::filesystem::path& file);

/// The same of a text.
std::string text_hash(std::string_view text);

/// The same of the first bytes of a file.
/// @throws FileError if it cannot be read, or has fewer
std::string content_hash(const std::filesystem::path& file, std::uintmax_t n_bytes);

}  // namespace pipelines
