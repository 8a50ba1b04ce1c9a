#include "pipelines/study/sweep/sweep_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/base/files/hdf5_file.h"
#include "pipelines/write/fields/zone_fields.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A figure of all rows, one value per point.
struct FigureColumn {
  std::string name, unit;
  std::vector<double> values;
};

std::vector<FigureColumn> figure_columns(const std::vector<SweepRow>& rows) {
  std::vector<FigureColumn> columns;
  std::map<std::string, std::size_t> at;
  for (std::size_t p = 0; p < rows.size(); ++p)
    for (std::size_t f = 0; f < rows[p].figures.size(); ++f) {
      const auto figure = rows[p].figures[f];
      if (f < columns.size() && columns[f].name == figure.name) {  // most rows have the same figures
        columns[f].values[p] = figure.value;
        continue;
      }
      const auto [entry, is_new] = at.try_emplace(figure.name, columns.size());
      if (is_new) columns.push_back({figure.name, figure.unit, std::vector<double>(rows.size(), none)});
      columns[entry->second].values[p] = figure.value;
    }
  return columns;
}

std::vector<std::pair<std::string, std::vector<std::string>>> text_columns(
    const std::vector<SweepRow>& rows) {
  std::vector<std::pair<std::string, std::vector<std::string>>> columns;
  for (std::size_t p = 0; p < rows.size(); ++p)
    for (const auto& [name, text] : rows[p].texts) {
      const auto& wanted = name;
      auto column =
          std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.first == wanted; });
      if (column == columns.end())
        column = columns.insert(column, {name, std::vector<std::string>(rows.size())});
      column->second[p] = text;
    }
  return columns;
}

std::vector<std::string> refusals(const std::vector<SweepRow>& rows) {
  std::vector<std::string> texts;
  for (const auto& row : rows) texts.push_back(row.refused);
  return texts;
}

/// Whether the k-th key takes numbers alone, and so do all points.
bool is_numeric(const SweepPlan& plan, std::size_t k) {
  return plan.variations[k].is_numeric() &&
         std::all_of(plan.points.begin(), plan.points.end(),
                     [&](const auto& p) { return !std::isnan(p.numbers[k]); });
}

std::vector<std::size_t> all_points(const SweepPlan& plan) {
  std::vector<std::size_t> all(plan.points.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  return all;
}

/// The number of each point, from 1, and its keys.
std::vector<CsvColumn> key_columns(const SweepPlan& plan, const std::vector<std::size_t>& points) {
  const auto of_points = [&](const auto& of) {
    std::vector<std::decay_t<decltype(of(plan.points.front()))>> values;
    for (const auto p : points) values.push_back(of(plan.points[p]));
    return values;
  };
  std::vector<std::int64_t> numbers;
  for (const auto p : points) numbers.push_back(std::int64_t(p) + 1);
  std::vector<CsvColumn> columns{{"point", "", numbers}};
  for (std::size_t k = 0; k < plan.variations.size(); ++k) {
    const auto& variation = plan.variations[k];
    if (is_numeric(plan, k))
      columns.push_back(
          {variation.key, variation.unit, of_points([&](const SweepPoint& p) { return p.numbers[k]; })});
    else
      columns.push_back({variation.key, "", of_points([&](const SweepPoint& p) { return p.values[k]; })});
  }
  return columns;
}

/// A zone at a point, with the number that it has at all points.
struct FollowedZone {
  const SweptZone& zone;
  int number;
};

FieldTable<FollowedZone> followed_zone_fields() {
  const FieldTable<FollowedZone> name{
      {"body", quantities::text, "name of the body", [](const auto& z) { return z.zone.body; }},
      {"zone", quantities::count, "number within the body", [](const auto& z) { return z.number; }}};
  const FieldTable<FollowedZone> instant{
      {"instant", quantities::count, "of the peak, from 0", [](const auto& z) { return z.zone.instant; }}};
  const auto figures = fields_of_part<FollowedZone>(
      zone_figure_fields(), [](const auto& z) -> const ZoneFigures& { return z.zone; });
  return joined(joined(name, figures), instant);
}

}  // namespace

void write_sweep_csv(const std::filesystem::path& file, const SweepPlan& plan,
                     const std::vector<SweepRow>& rows, int n_threads) {
  auto columns = key_columns(plan, all_points(plan));
  columns.push_back({"refused", "", refusals(rows)});
  for (auto& column : figure_columns(rows))
    columns.push_back(in_shown_unit({column.name, column.unit, std::move(column.values)}));
  for (auto& [name, texts] : text_columns(rows)) columns.push_back({name, "", std::move(texts)});
  write_csv(file, columns, n_threads);
}

void write_sweep_zones(const std::filesystem::path& file, const SweepPlan& plan,
                       const std::vector<SweepRow>& rows, const std::vector<std::vector<int>>& numbers) {
  const auto fields = followed_zone_fields();
  std::vector<std::size_t> points;
  auto zones = Json::array();
  for (std::size_t p = 0; p < rows.size(); ++p)
    for (std::size_t z = 0; z < rows[p].zones.size(); ++z) {
      points.push_back(p);
      zones.push_back(whole_row(fields, {rows[p].zones[z], numbers[p][z]}));
    }
  auto columns = key_columns(plan, points);
  for (auto& column : csv_columns(fields_of(fields), zones)) columns.push_back(std::move(column));
  write_csv(file, columns);
}

void write_sweep_h5(const std::filesystem::path& file, const SweepPlan& plan,
                    const std::vector<SweepRow>& rows, const std::string& title) {
  const auto named = [](const std::string& group, std::string name) {
    std::replace(name.begin(), name.end(), '/', '-');
    return "/" + group + "/" + name;
  };
  AtomicFile whole(file);
  Hdf5Writer out(whole.temporary());
  out.attribute("/", "title", title);
  for (const auto& key : key_columns(plan, all_points(plan)))
    if (const auto* texts = std::get_if<std::vector<std::string>>(&key.cells))
      out.write(named("keys", key.name), *texts);
    else if (const auto* numbers = std::get_if<std::vector<double>>(&key.cells))
      out.write(named("keys", key.name), *numbers, {key.unit, ""});
  for (const auto& column : figure_columns(rows))
    out.write(named("figures", column.name), column.values, {column.unit, ""});
  for (const auto& [name, texts] : text_columns(rows)) out.write(named("texts", name), texts);
  out.write("/refused", refusals(rows));
  out.close();
  whole.commit();
}

std::string sweep_json(const SweepPlan& plan, const std::vector<SweepRow>& rows) {
  Json json;
  json["points"] = Json::array();
  for (std::size_t p = 0; p < rows.size(); ++p) {
    Json point = Json::object();
    for (std::size_t k = 0; k < plan.variations.size(); ++k)
      point["keys"][plan.variations[k].key] = plan.points[p].values[k];
    if (!rows[p].refused.empty()) point["refused"] = rows[p].refused;
    for (const auto f : rows[p].figures) {
      point["figures"][f.name]["value"] = std::isfinite(f.value) ? Json(f.value) : Json(nullptr);
      point["figures"][f.name]["unit"] = f.unit;
    }
    for (const auto& [name, text] : rows[p].texts) point["texts"][name] = text;
    json["points"].push_back(std::move(point));
  }
  return json.dump(2) + "\n";
}

}  // namespace pipelines
