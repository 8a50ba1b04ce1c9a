/// The tables of fields in pipelines/base/fields/README.md beside the results of a run.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace cases {

/// Expects of every CSV file that a table names the table's columns with their units, no other ones; of every
/// row of summary.json its keys; of report.html its titles for people.
/// @param results  directory of a run
/// @return names of the CSV files that were there
std::set<std::string> expect_fields_of_readme(const std::filesystem::path& results);

}  // namespace cases
