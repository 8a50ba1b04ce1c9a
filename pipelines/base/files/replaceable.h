/// The inputs of this process, and what an output may replace: nothing, or a regular file that is none of
/// them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

/// Remembers, as long as the process lives, a file that the user gave: a scene, a load table, a geometry. To
/// be called before the file is read: its content is hashed. May be called from any thread.
void note_input(const std::filesystem::path& file);

/// A file that was noted.
struct NotedInput {
  std::filesystem::path file;  ///< absolute
  std::string hash;            ///< content_hash when it was noted; empty: no regular file that can be read
};

/// Inputs in the order in which they were noted, each once.
std::vector<NotedInput> noted_inputs();

/// Whether they could be read, and have the same content now.
bool are_as_noted(const std::vector<NotedInput>& inputs);

/// @return why the file must not be replaced, as the end of a sentence that begins with its name; empty if
///         it may be, or does not exist. Links are not followed.
std::string why_not_replaceable(const std::filesystem::path& file);

/// @param option  that named the file, for the message; empty: none did
/// @throws OptionError naming option, file and remedy if the file must not be replaced
void require_replaceable(const std::filesystem::path& file, const std::string& option = "");

}  // namespace pipelines
