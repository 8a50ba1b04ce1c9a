/// Tables as comma-separated text: one title line, then one line per row, each ended by a line feed. Titles
/// are "name [unit]"; numbers are the shortest text that reads back to the same double ("nan", "inf" where
/// not finite); text is quoted after RFC 4180 where it holds a comma, a quote or a line break.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace pipelines {

struct CsvColumn {
  std::string name;
  std::string unit;  ///< empty: the title is the name alone
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>> cells;
};

/// The shortest text that reads back to the same double, independent of the locale.
std::string shortest(double value);

/// @param n_threads  that format rows; the bytes are the same for any number
/// @throws std::invalid_argument naming the column if the columns are not of one length; FileError naming the
/// file if it cannot be written
void write_csv(const std::filesystem::path& path, const std::vector<CsvColumn>& columns, int n_threads = 1);

}  // namespace pipelines
