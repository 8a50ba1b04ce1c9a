/// The outputs of a table of fields, from its rows in summary.json.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/base/fields/field.h"
#include "pipelines/base/files/csv.h"

namespace pipelines {

/// Columns of CSV in the units that people read, with fifteen digits; cells without a value are empty.
/// Positions are three columns, tensors six, ranges two (`_least`, `_most`), shares one of each name that a
/// row has.
/// @param rows  each with all fields (whole_row)
std::vector<CsvColumn> csv_columns(const std::vector<Field>& fields, const summary::Json& rows);

/// A field of a row as people read it, without its unit; "-": there is none, or nobody knows it.
std::string shown_value(const Field& field, const summary::Json& row);

/// What people read of rows: the titles of labelled fields with their units, and texts.
struct ShownRows {
  std::vector<std::string> titles;
  std::vector<std::vector<std::string>> cells;  ///< by row
};

/// The first table.
/// @param most  so many rows from the first
ShownRows shown_rows(const std::vector<Field>& fields, const summary::Json& rows, std::size_t most);

/// The first table of an object of rows by name, or of a list by number; the names first. Nothing where
/// people see no field.
/// @param title  over the names
/// @param first  number
ShownRows shown_named_rows(const std::string& title, const std::vector<Field>& fields,
                           const summary::Json& rows_by_name, int first = 1);

/// The second table: the first labelled field and the details; no cells without details.
ShownRows shown_details(const std::vector<Field>& fields, const summary::Json& rows, std::size_t most);

/// Prints rows on a terminal below an empty line: texts to the left, numbers to the right; nothing without
/// rows. A row with more or fewer cells than titles ends in a remark.
/// @param title  over the first column, in place of its own
/// @param notes  lines below each row; none: no lines
void print_rows(std::ostream& out, const std::string& title, const ShownRows& rows,
                const std::vector<std::vector<std::string>>& notes = {});
/// The same at the top of an output, without the empty line.
void print_first_rows(std::ostream& out, const std::string& title, const ShownRows& rows,
                      const std::vector<std::vector<std::string>>& notes = {});

/// Prints all fields of rows, those that summary.json leaves out too.
template <typename Row>
void print_list(std::ostream& out, const FieldTable<Row>& fields, const std::vector<Row>& list) {
  const auto rows = whole_rows(fields, list);
  const auto table = shown_rows(fields_of(fields), rows, rows.size());
  if (!table.titles.empty()) print_rows(out, table.titles.front(), table);
}

/// Table for a README: a line of each field with column and unit in CSV, key of summary.json, title in tables
/// for people, and meaning.
std::string markdown_table(const std::vector<Field>& fields);

}  // namespace pipelines
