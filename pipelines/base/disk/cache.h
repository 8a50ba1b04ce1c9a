/// The user's cache: files that any later run may take, whatever its scene and directory. The name of a file
/// is the hash of all that its content depends on. What was used longest ago goes first when the cache is
/// full.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

/// $XDG_CACHE_HOME/millstress, or ~/.cache/millstress.
/// @throws FileError if neither variable has an absolute path
std::filesystem::path cache_directory();

/// @param key_hash  text_hash of what the content depends on
/// @throws as cache_directory
std::filesystem::path cached_file(const std::string& key_hash);

/// Enters that a file was used now, as its time of access. A cache that cannot be written to stays as it is.
void mark_used(const std::filesystem::path& file);

/// Bytes that the cache may hold: $MILLSTRESS_CACHE_LIMIT in GB, by default 5.
/// @throws FileError if the variable is no size
std::uintmax_t cache_limit();

struct CachedFile {
  std::filesystem::path file;
  std::uintmax_t bytes = 0;
  std::int64_t used_ns = 0;  ///< when it was used last, since 1970
};

/// The files of the cache, those first that were used longest ago. Files with other names are none of it.
std::vector<CachedFile> cached_files();

/// Removes the files that were used longest ago, until the others keep to the limit. Another process that
/// reads one of them meanwhile keeps what it has opened.
void keep_cache_within(std::uintmax_t limit);

}  // namespace pipelines
