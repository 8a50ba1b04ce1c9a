#include "pipelines/base/fields/field_outputs.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/base/names/name_lists.h"

namespace pipelines {
namespace {

using summary::Json;

const std::array<std::string, 3> axes{"x", "y", "z"};
const std::array<std::string, 6> components{"xx", "yy", "zz", "xy", "yz", "xz"};

/// Parts of a key between its dots: "safety_by", "findley".
std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts{""};
  for (const char c : key)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// The number itself, or that of a figure.
const Json& bare_number(const Json& value) {
  return value.is_object() && value.contains("value") ? value.at("value") : value;
}

std::string number_cell(const Json& value, double one) {
  const auto& number = bare_number(value);
  return number.is_number() ? fmt::format("{:.15g}", number.get<double>() / one) : std::string();
}

/// A moment as a drive angle over all turns, in degrees.
std::string moment_cell(const Json& value) {
  if (!value.is_object()) return "";
  return fmt::format("{:.15g}", 360 * (value.at("turn").get<double>() - 1) +
                                    value.at("drive_angle_rad").get<double>() * 180 / pi);
}

/// The unit that numbers of a row have which brings its own.
ShownUnit own_unit_of(const Json& row) {
  return shown_unit(row.value("unit", ""));
}

std::string scalar_cell(const Field& field, const Json& row) {
  const auto& value = value_of(row, field);
  switch (field.quantity.shape) {
    case Shape::text:
      return value.is_string() ? value.get<std::string>() : std::string();
    case Shape::own_unit:
      return number_cell(value, own_unit_of(row).one);
    case Shape::unit:
      return own_unit_of(row).unit;
    case Shape::flag:
      return value.is_boolean() ? (value.get<bool>() ? "1" : "0") : "";
    case Shape::moment:
      return moment_cell(value);
    default:
      return number_cell(value, field.quantity.one);
  }
}

/// Item `i` of a list, null without it.
Json item(const Json& list, std::size_t i) {
  return list.is_array() && i < list.size() ? list[i] : Json(nullptr);
}

template <typename Cell>
CsvColumn column(std::string title, const Field& field, const Json& rows, const Cell& cell) {
  std::vector<std::string> cells;
  for (const auto& row : rows) cells.push_back(cell(row));
  return {std::move(title), field.quantity.unit, std::move(cells)};
}

template <typename Names>
void add_items(std::vector<CsvColumn>& columns, const Field& field, const Json& rows, const Names& titles) {
  for (std::size_t i = 0; i < titles.size(); ++i)
    columns.push_back(column(titles[i], field, rows, [&](const Json& row) {
      return number_cell(item(value_of(row, field), i), field.quantity.one);
    }));
}

template <typename Names>
std::vector<std::string> with_prefix(const std::string& prefix, const Names& names) {
  std::vector<std::string> titles;
  for (const auto& name : names) titles.push_back(prefix + name);
  return titles;
}

/// Names of the shares of all rows, in the order in which they come.
std::vector<std::string> names_of_shares(const Field& field, const Json& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows)
    for (const auto& [name, share] : value_of(row, field).items())
      if (!contains(names, name)) names.push_back(name);
  return names;
}

void add_columns(std::vector<CsvColumn>& columns, const Field& field, const Json& rows) {
  switch (field.quantity.shape) {
    case Shape::structure:
      return;
    case Shape::position:
      return add_items(columns, field, rows, axes);
    case Shape::tensor:
      return add_items(columns, field, rows, with_prefix(field.column + "_", components));
    case Shape::range:
      return add_items(columns, field, rows, std::vector{field.column + "_least", field.column + "_most"});
    case Shape::shares:
      for (const auto& name : names_of_shares(field, rows))
        columns.push_back(column(field.column + name, field, rows, [&](const Json& row) {
          const auto& value = value_of(row, field);
          return value.is_object() && value.contains(name) ? number_cell(value.at(name), field.quantity.one)
                                                           : std::string();
        }));
      return;
    default:
      columns.push_back(
          column(field.column, field, rows, [&](const Json& row) { return scalar_cell(field, row); }));
  }
}

/// What rounds to zero has no sign.
std::string formatted(const Json& value, const Quantity& quantity, double one) {
  const auto& number = bare_number(value);
  if (!number.is_number()) return "-";
  auto text = fmt::format(fmt::runtime(quantity.format), number.get<double>() / one);
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  return is_zero && text[0] == '-' ? text.substr(1) : text;
}

std::string title_of(const Field& field) {
  const std::string unit = field.shown || field.quantity.shape == Shape::moment ? "" : field.quantity.unit;
  return field.label.empty() || unit.empty() ? field.label + unit : field.label + " " + unit;
}

bool is_seen(const Field& field, const Json& rows) {
  return !field.label.empty() &&
         (!field.is_optional || std::any_of(rows.begin(), rows.end(), [&](const Json& row) {
           return !value_of(row, field).is_null();
         }));
}

ShownRows shown(const std::vector<const Field*>& fields, const Json& rows, std::size_t most) {
  ShownRows table;
  for (const auto* field : fields) table.titles.push_back(title_of(*field));
  for (const auto& row : rows) {
    if (table.cells.size() == most) break;
    auto& cells = table.cells.emplace_back();
    for (const auto* field : fields) cells.push_back(shown_value(*field, row));
  }
  return table;
}

/// How many signs a terminal shows of UTF-8: bytes that do not go on with another.
std::size_t width(const std::string& text) {
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

bool begins_as_number(const std::string& cell) {
  return cell.find_first_of("0123456789-+") == 0;
}

void print_cell(std::ostream& out, const std::string& cell, std::size_t columns, bool to_the_right) {
  const std::string space(columns - width(cell), ' ');
  out << (to_the_right ? space + cell : cell + space);
}

/// Rows of summary.json may be without it.
bool may_be_missing(const Field& field) {
  return field.is_optional || field.quantity.shape == Shape::structure;
}

}  // namespace

const Json& value_of(const Json& row, const Field& field) {
  static const Json none = nullptr;
  const Json* at = &row;
  for (const auto& part : parts_of(field.json_key())) {
    if (!at->is_object() || !at->contains(part)) return none;
    at = &at->at(part);
  }
  return *at;
}

void set_value(Json& row, const Field& field, Json value) {
  Json* at = &row;
  for (const auto& part : parts_of(field.json_key())) at = &(*at)[part];
  *at = std::move(value);
}

std::vector<CsvColumn> csv_columns(const std::vector<Field>& fields, const Json& rows) {
  std::vector<CsvColumn> columns;
  for (const auto& field : fields)
    if (field.is_in_csv) add_columns(columns, field, rows);
  return columns;
}

std::string shown_value(const Field& field, const Json& row) {
  if (field.shown) return field.shown(row);
  const auto& value = value_of(row, field);
  const auto& quantity = field.quantity;
  const auto text_of = [&](const Json& number) { return formatted(number, quantity, quantity.one); };
  switch (quantity.shape) {
    case Shape::text:
      return value.is_string() ? value.get<std::string>() : "-";
    case Shape::flag:
      return value.is_boolean() && value.get<bool>() ? "yes" : "-";
    case Shape::position:
      return fmt::format("({}, {}, {})", text_of(item(value, 0)), text_of(item(value, 1)),
                         text_of(item(value, 2)));
    case Shape::own_unit:
      return formatted(value, quantity, own_unit_of(row).one);
    case Shape::unit:
      return own_unit_of(row).unit;
    case Shape::moment:
      return value.is_object() ? fmt::format("turn {}, {} deg", value.at("turn").get<int>(),
                                             text_of(value.at("drive_angle_rad")))
                               : "-";
    default:
      return text_of(value);
  }
}

ShownRows shown_rows(const std::vector<Field>& fields, const Json& rows, std::size_t most) {
  std::vector<const Field*> seen;
  for (const auto& field : fields)
    if (is_seen(field, rows) && !field.is_detail) seen.push_back(&field);
  return shown(seen, rows, most);
}

ShownRows shown_named_rows(const std::string& title, const std::vector<Field>& fields,
                           const Json& rows_by_name, int first) {
  auto rows = Json::array();
  for (const auto& row : rows_by_name) rows.push_back(row);
  auto table = shown_rows(fields, rows, rows.size());
  if (table.titles.empty()) return {};
  table.titles.insert(table.titles.begin(), title);
  auto cells = table.cells.begin();
  for (const auto& [name, row] : rows_by_name.items()) {
    cells->insert(cells->begin(), rows_by_name.is_array() ? std::to_string(first++) : name);
    ++cells;
  }
  return table;
}

ShownRows shown_details(const std::vector<Field>& fields, const Json& rows, std::size_t most) {
  std::vector<const Field*> seen;
  for (const auto& field : fields)
    if (is_seen(field, rows) && (field.is_detail || seen.empty())) seen.push_back(&field);
  return seen.size() > 1 ? shown(seen, rows, most) : ShownRows{};
}

void print_rows(std::ostream& out, const std::string& title, const ShownRows& rows,
                const std::vector<std::vector<std::string>>& notes) {
  if (rows.cells.empty()) return;
  out << '\n';
  print_first_rows(out, title, rows, notes);
}

void print_first_rows(std::ostream& out, const std::string& title, const ShownRows& rows,
                      const std::vector<std::vector<std::string>>& notes) {
  if (rows.cells.empty()) return;
  auto titles = rows.titles;
  titles.front() = title;
  std::vector<std::size_t> widths;
  std::vector<bool> to_the_right;
  for (std::size_t c = 0; c < titles.size(); ++c) {
    std::size_t most = width(titles[c]);
    bool has_numbers = c > 0;
    for (const auto& cells : rows.cells) {
      if (cells.size() != titles.size() && c + 1 >= cells.size()) continue;  // a remark
      most = std::max(most, width(cells[c]));
      has_numbers = has_numbers && begins_as_number(cells[c]);
    }
    widths.push_back(most);
    to_the_right.push_back(has_numbers);
  }
  const auto print_line = [&](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      out << "  ";
      const bool is_last = c + 1 == cells.size() && (cells.size() != titles.size() || !to_the_right[c]);
      print_cell(out, cells[c], is_last ? width(cells[c]) : widths[c], !is_last && to_the_right[c]);
    }
    out << '\n';
  };
  print_line(titles);
  for (std::size_t row = 0; row < rows.cells.size(); ++row) {
    print_line(rows.cells[row]);
    if (row >= notes.size()) continue;
    for (const auto& note : notes[row])
      if (!note.empty()) out << "       " << note << '\n';
  }
}

std::string markdown_table(const std::vector<Field>& fields) {
  const auto names = [](const Field& field) {
    const auto& c = field.column;
    if (!field.is_in_csv) return std::string();
    switch (field.quantity.shape) {
      case Shape::position:
        return std::string("`x`, `y`, `z`");
      case Shape::tensor:
        return fmt::format("`{}_xx` ... `{}_xz`", c, c);
      case Shape::range:
        return fmt::format("`{}_least`, `{}_most`", c, c);
      case Shape::shares:
        return fmt::format("`{}<name>`", c);
      default:
        return "`" + c + "`";
    }
  };
  const auto has_csv = std::any_of(fields.begin(), fields.end(), [](const auto& f) { return f.is_in_csv; });
  std::string text =
      has_csv ? "| column | unit | in `summary.json` | for people | meaning |\n|---|---|---|---|---|\n"
              : "| in `summary.json` | for people | meaning |\n|---|---|---|\n";
  for (const auto& field : fields) {
    if (has_csv) text += fmt::format("| {} | {} ", names(field), field.is_in_csv ? field.quantity.unit : "");
    text += fmt::format("| {} | {} | {} |\n", field.is_in_summary ? "`" + field.json_key() + "`" : "",
                        field.label.empty() ? "" : title_of(field),
                        field.meaning + (may_be_missing(field) ? " (where there is one)" : ""));
  }
  return text;
}

}  // namespace pipelines
