/// Damaged results of an earlier run.
#pragma once

#include <filesystem>

#include "tests/fuzz/kinds/cases.h"

namespace fuzz {

/// Writes a result directory with damage in one of its files.
void write_damaged_results(Mutator& random, const Place& place, const std::filesystem::path& directory);

}  // namespace fuzz
