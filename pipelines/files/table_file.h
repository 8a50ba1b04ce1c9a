/// Tables of numbers with units, as engineers and loggers write them.
///
/// The first line names the columns, "name [unit]"; every other line has one number per column. Columns are
/// separated by commas, or by semicolons or tabs if the first line has one of these; names may be quoted.
/// Empty lines and lines that begin with # are passed over. Numbers have a decimal point.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

struct TableColumn {
  std::string name, unit;  ///< as written in the first line; unit empty if none is given
  int column = 1;          ///< 1-based position of the name in its line, for messages
  std::vector<double> values;
};

struct TableFile {
  std::filesystem::path file;
  int title_line = 1;
  std::vector<TableColumn> columns;
  std::vector<int> lines;  ///< of each row, for messages
  std::size_t n_rows() const { return lines.size(); }
  /// A sentence about a file that may be cut off: its last line has no end, or fewer digits than all others
  /// have alike, or its first column makes another step there after even ones. Empty: nothing speaks for it.
  std::string doubt;
};

/// @throws SceneError with every wrong cell, up to ten, as file:line:column, column's name, cell, remedy: a
///         file that cannot be read or has more than 500 MB, no title line, no rows, a row of another length,
///         a cell that is no finite number, a column without a name or with that of another
TableFile read_table_file(const std::filesystem::path& file);

}  // namespace pipelines
