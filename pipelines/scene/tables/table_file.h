/// Tables of numbers with units, as engineers and loggers write them.
///
/// A line of titles names the columns, "name [unit]", "name (unit)" or "name / unit"; the units may stand in
/// the line below instead. Every line under them has one number per column. Columns are separated by
/// semicolons, tabs, commas or runs of blanks; names may be quoted. Numbers have a decimal point or, where
/// commas do not separate the columns, a decimal comma; thousands have no separators. Empty lines and lines
/// that begin with # are passed over, lines of another form above the titles too. The text is UTF-8, UTF-16
/// or Windows-1252.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipelines/scene/tables/table_layout.h"
#include "pipelines/scene/tables/table_title.h"

namespace pipelines {

struct TableColumn {
  std::string name, unit;  ///< unit empty if none is given
  int column = 1;          ///< 1-based position of the name in its line, for messages
  std::vector<double> values;
  TableTitle title;
};

struct TableFile {
  std::filesystem::path file;
  int title_line = 1;
  std::vector<TableColumn> columns;
  std::vector<int> lines;  ///< line of each row, for messages
  std::size_t n_rows() const { return lines.size(); }
  /// A sentence about a file that may be cut off: its last line has no end, or fewer digits than all others
  /// have alike, or its first column makes another step there after even ones. Empty: nothing speaks for it.
  std::string doubt;
  std::string form;  ///< how it is written: "';' with decimal comma, Windows-1252, units in row 2"
};

/// A table whose titles are known and whose rows are not read yet.
struct OpenTable {
  std::filesystem::path file;
  std::shared_ptr<const std::string> text;  ///< UTF-8
  std::string encoding;
  TableForm form;
  TableLayout layout;
  /// One for each column, without values; an empty title at the end is none.
  std::vector<TableColumn> columns;
};

/// @param wanted  titles that are looked for; may be empty
/// @throws SceneError as file:line:column, value, remedy: a file that cannot be read, has more than 500 MB,
/// or
///         is no text; no line of titles
OpenTable open_table(const std::filesystem::path& file, const TableForm& form = {},
                     const std::vector<std::string>& wanted = {});

/// Whether titles name the columns, each another one, or the scene has chosen columns whatever their titles.
enum class Titles { name_columns, are_chosen };

/// @param chosen  columns by their index, in the order in which they are wanted
/// @throws SceneError, one finding for each column and kind of fault with their number, up to ten: no rows, a
///         row of another length, a cell that is no finite number, separators of thousands, decimal points
///         and commas in one file, or commas that may be either; a column without a name or with that of
///         another
TableFile read_columns(const OpenTable& table, const std::vector<std::size_t>& chosen,
                       Titles titles = Titles::name_columns);

/// Reads all columns of a file.
TableFile read_table_file(const std::filesystem::path& file);

}  // namespace pipelines
