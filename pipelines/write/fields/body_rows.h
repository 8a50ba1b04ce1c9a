/// Rows of a body's results, for the tables of fields.
#pragma once

#include <filesystem>
#include <vector>

#include "pipelines/base/fields/field.h"
#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/texts/moment.h"

namespace pipelines {

/// A body's result and the cycle that it belongs to.
struct BodyResult {
  const Scene& scene;  ///< scene of the run, with the instants of the loads
  const kinetics::LoadHistory& loads;
  const Judged& analysis;
};

/// The moment of an instant that may lie between two.
inline summary::Json moment_json(const BodyResult& body, double instant) {
  const auto moment = moment_between(body.scene, body.loads, instant);
  return summary::object({{"turn", moment.turn}, {"drive_angle_rad", moment.angle_rad}});
}

/// One item of a body's result: a zone, a place, a weld toe ...
template <typename Item>
struct RowOf {
  const BodyResult& body;
  const Item& item;
  std::size_t index;  ///< from 0
};

/// A member of the item; a number has to be finite.
template <typename Value, typename Item>
auto of_item(Value Item::*member) {
  return [=](const auto& row) -> summary::Json {
    if constexpr (std::is_same_v<Value, double>) return summary::number(row.item.*member);
    return row.item.*member;
  };
}

template <typename Item>
std::vector<RowOf<Item>> rows_of_items(const BodyResult& body, const std::vector<Item>& items) {
  std::vector<RowOf<Item>> rows;
  for (const auto& item : items) rows.push_back({body, item, rows.size()});
  return rows;
}

/// Rows as summary.json has them.
template <typename Item>
summary::Json summary_rows(const FieldTable<RowOf<Item>>& fields, const BodyResult& body,
                           const std::vector<Item>& items) {
  return summary_rows(fields, rows_of_items(body, items));
}

/// Writes rows as a CSV file.
template <typename Item>
void write_rows(const std::filesystem::path& file, const FieldTable<RowOf<Item>>& fields,
                const BodyResult& body, const std::vector<Item>& items) {
  write_csv(file, csv_columns(fields_of(fields), whole_rows(fields, rows_of_items(body, items))));
}

}  // namespace pipelines
