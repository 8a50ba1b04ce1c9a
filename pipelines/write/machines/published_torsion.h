/// The tables of the root peeler's paper, as a command prints and writes them.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "kinetics/published_tables.h"

namespace pipelines {

/// Tables 1 to 7 as text. What they say about their origin depends on whether the numbers are the paper's.
void print_published(std::ostream& out, const kinetics::PublishedTables& tables);

/// agrees_with_print, origin; table_1, tables_2_3, tables_5_6: inertias, elements, excitation; table_4,
/// table_7: frequencies [rad/s], modes (a list of each, unit length), forced angles [rad].
nlohmann::ordered_json published_json(const kinetics::PublishedTables& tables);

/// Names of the files that write_published writes.
const std::vector<std::string>& published_files();

void write_published(const std::filesystem::path& directory, const kinetics::PublishedTables& tables);

}  // namespace pipelines
