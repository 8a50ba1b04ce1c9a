/// JSON files that earlier runs have left, which may be damaged or another's.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace pipelines {

/// Discarded (is_discarded()) where the file cannot be read, is larger than any result, is no JSON, or nests
/// deeper: the library follows what it writes and compares by recursion, and a page of brackets would
/// overflow the stack.
nlohmann::ordered_json read_json_file(const std::filesystem::path& file);

}  // namespace pipelines
