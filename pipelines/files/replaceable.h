/// What an output may replace: nothing, or a regular file that this process has not read as input.
#pragma once

#include <filesystem>
#include <string>

namespace pipelines {

/// Remembers, as long as the process lives, a file that the user gave: a scene, a load table, a geometry. May
/// be called from any thread.
void note_input(const std::filesystem::path& file);

/// @return why the file must not be replaced, as the end of a sentence that begins with its name; empty if
///         it may be, or does not exist. Links are not followed.
std::string why_not_replaceable(const std::filesystem::path& file);

/// @param option  that named the file, for the message; empty: none did
/// @throws OptionError naming option, file and remedy if the file must not be replaced
void require_replaceable(const std::filesystem::path& file, const std::string& option = "");

}  // namespace pipelines
