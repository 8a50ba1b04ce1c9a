/// Tables of fields: each figure of a result is declared once, as a row with its key, quantity, meaning and
/// value. summary.json, CSV, the tables of terminal and page, and those of the README come from that row.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "pipelines/base/fields/json_values.h"
#include "pipelines/base/fields/quantity.h"

namespace pipelines {

/// A field without its value: what the outputs of a row of summary.json need.
struct Field {
  std::string key;  ///< in summary.json before its unit; "safety_by.findley" lies in an object
  Quantity quantity;
  std::string meaning;     ///< for the README
  std::string column;      ///< title in CSV before its unit; of effects and blocks, before their names
  std::string label;       ///< over its column in tables for people; empty: it stands in none
  bool is_detail = false;  ///< stands in the second table for people, beside the first field
  bool is_in_csv = true, is_in_summary = true;
  bool is_optional = false;  ///< without a value summary.json has no key, without any people see no column
  /// What people read of a row of summary.json; empty: the value by its quantity.
  std::function<std::string(const summary::Json& row)> shown;

  /// The key with its unit: "amplitude_Pa".
  std::string json_key() const { return key + quantity.suffix; }
};

/// A field with its value of a `Row`. Its words chain, so that it reads as one line of a table:
/// FieldOf<Zone>("volume", quantities::volume, "above the level", "volume", &Zone::volume_m3)
template <typename Row>
struct FieldOf : Field {
  std::function<summary::Json(const Row&)> value;  ///< in SI, of the quantity's shape

  /// @param get  a function of a row, or a member of it; a member that is a number has to be finite
  template <typename Get>
  FieldOf(std::string name, const Quantity& of, std::string what_it_means, const Get& get)
      : FieldOf(std::move(name), of, std::move(what_it_means), "", get) {}
  /// @param title  under which people see it, with its unit
  template <typename Get>
  FieldOf(std::string name, const Quantity& of, std::string what_it_means, std::string title,
          const Get& get) {
    key = name;
    column = std::move(name);
    quantity = of;
    meaning = std::move(what_it_means);
    label = std::move(title);
    is_in_csv = of.shape != Shape::structure;
    if constexpr (std::is_convertible_v<Get, double Row::*>)
      value = [=](const Row& row) { return summary::number(row.*get); };
    else
      value = get;
  }

  /// People see it, in the second table.
  FieldOf detail(std::string title) const {
    auto field = *this;
    field.label = std::move(title);
    field.is_detail = true;
    return field;
  }
  /// The field with other digits than the quantity's.
  FieldOf digits(const char* format) const {
    auto field = *this;
    field.quantity.format = format;
    return field;
  }
  /// The field with a text made of the whole row, such as "8 h (3 to 27)".
  FieldOf shown_as(std::function<std::string(const summary::Json& row)> text) const {
    auto field = *this;
    field.shown = std::move(text);
    return field;
  }
  /// The field under another title in CSV; of effects and blocks, before their names.
  FieldOf in_column(std::string title) const {
    auto field = *this;
    field.column = std::move(title);
    return field;
  }
  /// summary.json has it, a CSV file has not.
  FieldOf without_csv() const {
    auto field = *this;
    field.is_in_csv = false;
    return field;
  }
  /// A CSV file has it, summary.json has not.
  FieldOf without_summary() const {
    auto field = *this;
    field.is_in_summary = false;
    return field;
  }
  /// The field that may have no value: then summary.json has no key; where no row has one, people see no
  /// column.
  FieldOf optional() const {
    auto field = *this;
    field.is_optional = true;
    return field;
  }
};

template <typename Row>
using FieldTable = std::vector<FieldOf<Row>>;

/// One table after the other.
template <typename Row>
FieldTable<Row> joined(FieldTable<Row> first, const FieldTable<Row>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// The fields of a part of a row.
/// @param of  the part: of(row)
template <typename Row, typename Part, typename Of>
FieldTable<Row> fields_of_part(const FieldTable<Part>& fields, const Of& of) {
  FieldTable<Row> taken;
  for (const auto& field : fields) {
    taken.emplace_back(field.key, field.quantity, field.meaning,
                       [=, get = field.value](const Row& row) { return get(of(row)); });
    static_cast<Field&>(taken.back()) = field;
  }
  return taken;
}

/// The fields of a result that has no CSV file.
template <typename Row>
FieldTable<Row> without_csv(FieldTable<Row> fields) {
  for (auto& field : fields) field.is_in_csv = false;
  return fields;
}

/// A place in a row of summary.json, by a key with dots. Null where the row has none, as results of earlier
/// versions.
const summary::Json& value_of(const summary::Json& row, const Field& field);

/// Puts a value where the field stands in a row.
void set_value(summary::Json& row, const Field& field, summary::Json value);

/// A row with all fields, also those that summary.json leaves to CSV.
template <typename Row>
summary::Json whole_row(const FieldTable<Row>& fields, const Row& of) {
  auto json = summary::Json::object();
  for (const auto& field : fields) set_value(json, field, field.value(of));
  return json;
}

/// A row as summary.json has it.
template <typename Row>
summary::Json summary_row(const FieldTable<Row>& fields, const Row& of) {
  auto json = summary::Json::object();
  for (const auto& field : fields) {
    if (!field.is_in_summary) continue;
    auto value = field.value(of);
    if (!value.is_null() || !field.is_optional) set_value(json, field, std::move(value));
  }
  return json;
}

/// Rows of a list with all fields, as CSV files have them.
template <typename Row>
summary::Json whole_rows(const FieldTable<Row>& fields, const std::vector<Row>& list) {
  auto rows = summary::Json::array();
  for (const auto& row : list) rows.push_back(whole_row(fields, row));
  return rows;
}

/// Rows of a list as summary.json has them.
template <typename Row>
summary::Json summary_rows(const FieldTable<Row>& fields, const std::vector<Row>& list) {
  auto rows = summary::Json::array();
  for (const auto& row : list) rows.push_back(summary_row(fields, row));
  return rows;
}

/// The fields without their values.
template <typename Row>
std::vector<Field> fields_of(const FieldTable<Row>& fields) {
  return {fields.begin(), fields.end()};
}

}  // namespace pipelines
