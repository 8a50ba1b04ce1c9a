/// What every refusal has to be like, and what a directory must not hold afterwards.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/fuzz/kinds/cases.h"

namespace fuzz {

std::string read_bytes(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, const std::string& bytes);

/// Runs what may refuse its input as the program's main would: only errors of the types that mean a user's
/// mistake or work that failed, with a message that names the file.
/// @param named   a part of the file's name, in every message
/// @param action  returns its fault; empty: none
Verdict judged(const std::string& named, const std::function<std::string()>& action);

/// The same for messages, as they stand on the terminal. @return the fault
std::string fault_of_message(const std::string& message, const std::vector<std::string>& named);

/// Every file below a directory with its bytes, hidden ones too.
std::map<std::string, std::string> all_files(const std::filesystem::path& directory);

/// The first file that is in one only, or differs; empty: they are equal.
std::string difference(const std::map<std::string, std::string>& a,
                       const std::map<std::string, std::string>& b);

/// Files that are not written to their end. @return the fault
std::string fault_of_leftovers(const std::filesystem::path& directory);

}  // namespace fuzz
