/// Where titles, units and rows stand in a table that another program wrote.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipelines/scene/tables/table_cells.h"

namespace pipelines {

/// What the user says of a file; what is left 0 or -1 is found.
struct TableForm {
  char delimiter = 0;  ///< as in table_cells.h
  char decimal = 0;    ///< '.' or ','
  int skip_rows = -1;  ///< lines before the one of the titles
};

struct TableLine {
  int number = 0;  ///< 1-based
  std::string_view text;
};

/// The lines of a text, which must outlive it: they end with a line feed, or with a carriage return where
/// there is no line feed at all. Empty lines and those that begin with # are passed over.
class TableLines {
public:
  explicit TableLines(std::string_view text);
  /// False behind the last line.
  bool next(TableLine& line);
  bool has_last_end() const { return has_last_end_; }  ///< each line read so far has its end

private:
  std::string_view rest_;
  char end_;
  int number_ = 0;
  bool has_last_end_ = true;
};

struct TableLayout {
  char delimiter = ',';
  int title_line = 0;  ///< 0: the text has no lines
  int unit_line = 0;   ///< 0: no line of units
  std::vector<Cell> titles, units;
  int first_row = 1;  ///< the line: those between it and the titles have no number, or are none
};

/// The rows are the longest stretch of lines with numbers in as many cells; the titles stand above them, with
/// a line of units between or not. Where there is no such stretch, the first line has the titles.
/// @param wanted  titles that are looked for: of several lines above the rows the one that has them
TableLayout find_layout(std::string_view text, const TableForm& form, const std::vector<std::string>& wanted);

/// Whether as many cells as titles; one empty cell more at the end of either does not count.
bool agree_in_number(const std::vector<Cell>& titles, const std::vector<Cell>& cells);

}  // namespace pipelines
