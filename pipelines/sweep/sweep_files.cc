#include "pipelines/sweep/sweep_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "pipelines/files/atomic_file.h"
#include "pipelines/files/csv.h"
#include "pipelines/files/hdf5_file.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Of all rows, one value per point, in the order in which figures appear.
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

/// Of the points, numbers where all that the key takes are numbers.
bool is_numeric(const SweepPlan& plan, std::size_t k) {
  return plan.variations[k].is_numeric() &&
         std::all_of(plan.points.begin(), plan.points.end(),
                     [&](const auto& p) { return !std::isnan(p.numbers[k]); });
}

template <typename Of>
auto by_point(const SweepPlan& plan, const Of& of) {
  std::vector<std::decay_t<decltype(of(plan.points.front()))>> values;
  for (const auto& point : plan.points) values.push_back(of(point));
  return values;
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

}  // namespace

void write_sweep_csv(const std::filesystem::path& file, const SweepPlan& plan,
                     const std::vector<SweepRow>& rows, int n_threads) {
  std::vector<std::size_t> all(rows.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  auto columns = key_columns(plan, all);
  columns.push_back({"refused", "", refusals(rows)});
  for (auto& column : figure_columns(rows))
    columns.push_back({column.name, column.unit, std::move(column.values)});
  for (auto& [name, texts] : text_columns(rows)) columns.push_back({name, "", std::move(texts)});
  write_csv(file, columns, n_threads);
}

void write_sweep_zones(const std::filesystem::path& file, const SweepPlan& plan,
                       const std::vector<SweepRow>& rows, const std::vector<std::vector<int>>& numbers) {
  std::vector<std::size_t> points;
  std::vector<const SweptZone*> zones;
  std::vector<std::int64_t> followed;
  for (std::size_t p = 0; p < rows.size(); ++p)
    for (std::size_t z = 0; z < rows[p].zones.size(); ++z) {
      points.push_back(p);
      zones.push_back(&rows[p].zones[z]);
      followed.push_back(numbers[p][z]);
    }
  auto columns = key_columns(plan, points);
  const auto add = [&](const std::string& name, const std::string& unit, const auto& of) {
    std::vector<std::decay_t<decltype(of(SweptZone()))>> values;
    for (const auto* zone : zones) values.push_back(of(*zone));
    columns.push_back({name, unit, std::move(values)});
  };
  add("body", "", [](const SweptZone& z) { return z.body; });
  columns.push_back({"zone", "", followed});
  add("feature", "", [](const SweptZone& z) { return z.feature; });
  add("place", "", [](const SweptZone& z) { return z.place; });
  add("peak_von_mises", "Pa", [](const SweptZone& z) { return z.peak_Pa; });
  add("peak_error", "Pa", [](const SweptZone& z) { return z.error_Pa; });
  add("safety_against_yield", "", [](const SweptZone& z) { return z.safety; });
  add("instant", "", [](const SweptZone& z) { return z.instant; });
  for (std::size_t c = 0; c < 3; ++c)
    add(std::string(1, "xyz"[c]), "m", [&](const SweptZone& z) { return z.peak_m[c]; });
  add("volume", "m3", [](const SweptZone& z) { return z.volume_m3; });
  add("nodes", "", [](const SweptZone& z) { return z.n_nodes; });
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
  for (std::size_t k = 0; k < plan.variations.size(); ++k) {
    const auto& variation = plan.variations[k];
    if (is_numeric(plan, k))
      out.write(named("keys", variation.key),
                by_point(plan, [&](const SweepPoint& p) { return p.numbers[k]; }), {variation.unit, ""});
    else
      out.write(named("keys", variation.key),
                by_point(plan, [&](const SweepPoint& p) { return p.values[k]; }));
  }
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
