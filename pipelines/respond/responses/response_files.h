/// Unit responses kept between runs, under a key that stands for all they depend on.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "fem/base/values/unit_responses.h"

namespace pipelines {

/// Writes every field, exactly and compressed, with a checksum behind (kept_file.h). The large arrays are
/// written in place, without copies. Called on all ranks that share the body; what fails throws on the first.
/// @throws std::invalid_argument naming the field if the sizes of the fields do not fit each other;
///         std::runtime_error naming the file if it cannot be written
void write_unit_responses(const std::filesystem::path& path, const std::string& key,
                          const fem::UnitResponses& responses);

/// Takes a line for the user.
using Tell = std::function<void(const std::string&)>;

/// @param tell  called if the file is damaged, or is none of this version's
/// @return empty if the file is missing, damaged, or was written under another key: compute them anew then
std::optional<fem::UnitResponses> read_unit_responses(const std::filesystem::path& path,
                                                      const std::string& key, const Tell& tell = {});

}  // namespace pipelines
