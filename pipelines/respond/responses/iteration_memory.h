/// What an earlier run has learnt about the iterative solver, kept beside unit_responses.h5.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/respond/responses/response_files.h"

namespace pipelines {

/// Whether the iteration gave up on the body with this key (body_key), whatever its loads. A file that is
/// missing, damaged or about another body says no.
/// @param tell  called if the file is damaged
bool iteration_gave_up_before(const std::filesystem::path& directory, const std::string& key,
                              const Tell& tell = {});

/// Writes `iteration_gave_up.txt`, or removes it.
/// @throws FileError naming the file if it cannot be written
void remember_iteration(const std::filesystem::path& directory, const std::string& key, bool gave_up);

}  // namespace pipelines
