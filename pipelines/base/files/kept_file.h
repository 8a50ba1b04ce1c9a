/// Files that are kept for a later run. Their last line has two checksums: of the key that says what the
/// content was made from, and of all before it. It is checked before anything in the file is believed, and
/// before a library sees it: HDF5 may crash on damaged metadata, and ignores bytes behind its own end.
#pragma once

#include <filesystem>
#include <string_view>

namespace pipelines {

enum class KeptFile {
  missing,
  other_key,  ///< made from something else; whether it is damaged is not looked at
  damaged,    ///< cut, changed, unreadable, of another program or of a version without checksums
  whole
};

/// Appends the line to a finished file.
/// @throws FileError if it cannot be written
void append_checksum(const std::filesystem::path& file, std::string_view key);

/// Reads the whole file if the key fits.
KeptFile check_kept_file(const std::filesystem::path& file, std::string_view key);

/// What the first of the ranks that share a body finds. Called on all of them.
KeptFile checked_on_first_rank(const std::filesystem::path& file, std::string_view key);

/// The same for a key of which only its text_hash is known.
/// @param key_hash  empty: any key will do
KeptFile check_kept_file_of(const std::filesystem::path& file, std::string_view key_hash);

/// Words for the user: what a damaged file is called, and what becomes of it.
std::string damaged_file_text(const std::filesystem::path& file);

}  // namespace pipelines
