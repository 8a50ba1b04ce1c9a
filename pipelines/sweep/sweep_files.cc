#include "pipelines/sweep/sweep_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "pipelines/common/errors.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/files/content_hash.h"
#include "pipelines/files/csv.h"
#include "pipelines/files/hdf5_file.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t digits_of_hash = 32;

/// Of all rows, one value per point, in the order in which figures appear.
struct FigureColumn {
  std::string name, unit;
  std::vector<double> values;
};

std::vector<FigureColumn> figure_columns(const std::vector<SweepRow>& rows) {
  std::vector<FigureColumn> columns;
  std::map<std::string, std::size_t> at;
  for (std::size_t p = 0; p < rows.size(); ++p)
    for (const auto& figure : rows[p].figures) {
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

Json row_json(const SweepRow& row) {
  Json json = Json::object();
  json["refused"] = row.refused;
  json["figures"] = Json::array();
  for (const auto& f : row.figures) json["figures"].push_back({f.name, f.unit, shortest(f.value)});
  json["texts"] = Json::array();
  for (const auto& [name, text] : row.texts) json["texts"].push_back({name, text});
  return json;
}

SweepRow row_of(const Json& json) {
  SweepRow row;
  row.refused = json.at("refused");
  for (const auto& f : json.at("figures")) {
    const std::string text = f.at(2);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) value = none;
    row.figures.push_back({f.at(0), f.at(1), value});
  }
  for (const auto& t : json.at("texts")) row.texts.emplace_back(t.at(0), t.at(1));
  return row;
}

std::string line_of(const std::string& text) {
  return text_hash(text) + ' ' + text + '\n';
}

/// The text of a line whose checksum is right; empty of any other.
std::string checked(const std::string& line) {
  if (line.size() <= digits_of_hash + 1) return "";
  const auto text = line.substr(digits_of_hash + 1);
  return line.compare(0, digits_of_hash, text_hash(text)) == 0 ? text : "";
}

}  // namespace

void write_sweep_csv(const std::filesystem::path& file, const SweepPlan& plan,
                     const std::vector<SweepRow>& rows) {
  std::vector<std::int64_t> numbers(rows.size());
  for (std::size_t p = 0; p < rows.size(); ++p) numbers[p] = std::int64_t(p) + 1;
  std::vector<CsvColumn> columns{{"point", "", numbers}};
  for (std::size_t k = 0; k < plan.variations.size(); ++k) {
    const auto& variation = plan.variations[k];
    if (is_numeric(plan, k))
      columns.push_back(
          {variation.key, variation.unit, by_point(plan, [&](const SweepPoint& p) { return p.numbers[k]; })});
    else
      columns.push_back(
          {variation.key, "", by_point(plan, [&](const SweepPoint& p) { return p.values[k]; })});
  }
  columns.push_back({"refused", "", refusals(rows)});
  for (auto& column : figure_columns(rows))
    columns.push_back({column.name, column.unit, std::move(column.values)});
  for (auto& [name, texts] : text_columns(rows)) columns.push_back({name, "", std::move(texts)});
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
    for (const auto& f : rows[p].figures) {
      point["figures"][f.name]["value"] = std::isfinite(f.value) ? Json(f.value) : Json(nullptr);
      point["figures"][f.name]["unit"] = f.unit;
    }
    for (const auto& [name, text] : rows[p].texts) point["texts"][name] = text;
    json["points"].push_back(std::move(point));
  }
  return json.dump(2) + "\n";
}

SweepJournal::SweepJournal(std::filesystem::path file, std::string key)
    : file_(std::move(file)), key_(text_hash(key)) {}

void SweepJournal::require_own() const {
  std::error_code none;
  const auto refuse = [](const std::filesystem::path& file) {
    throw OptionError("-o: " + file.string() +
                      " is there, but no sweep has written it; name another directory");
  };
  if (!std::filesystem::exists(file_, none)) {
    for (const char* name : {"sweep.csv", "sweep.h5"})
      if (const auto file = file_.parent_path() / name; std::filesystem::exists(file, none)) refuse(file);
    return;
  }
  std::ifstream in(file_, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || checked(line).size() != digits_of_hash) refuse(file_);
}

std::vector<std::optional<SweepRow>> SweepJournal::known(const SweepPlan& plan) const {
  std::vector<std::optional<SweepRow>> rows(plan.points.size());
  std::ifstream in(file_, std::ios::binary);
  std::string line;
  if (!in || !std::getline(in, line) || checked(line) != key_) return rows;
  std::map<std::vector<std::string>, SweepRow> by_settings;
  while (std::getline(in, line)) {
    const auto text = checked(line);
    const auto json = Json::parse(text, nullptr, false);
    if (!json.is_object()) continue;
    auto row = row_of(json.at("row"));  // what refused a point may be gone: memory, a file
    if (row.refused.empty())
      by_settings[json.at("settings").get<std::vector<std::string>>()] = std::move(row);
  }
  for (std::size_t p = 0; p < rows.size(); ++p)
    if (const auto found = by_settings.find(plan.points[p].settings); found != by_settings.end())
      rows[p] = found->second;
  return rows;
}

void SweepJournal::begin(const SweepPlan& plan, const std::vector<std::optional<SweepRow>>& known) {
  pending_.clear();
  std::string content = line_of(key_);
  for (std::size_t p = 0; p < known.size(); ++p)
    if (known[p]) {
      append(plan.points[p], *known[p]);
    }
  content += pending_;
  pending_.clear();
  write_text_file(file_, content);
}

void SweepJournal::append(const SweepPoint& point, const SweepRow& row) {
  Json json = Json::object();
  json["settings"] = point.settings;
  json["row"] = row_json(row);
  pending_ += line_of(json.dump());
}

void SweepJournal::flush() {
  std::ofstream out(file_, std::ios::binary | std::ios::app);
  out << pending_;
  out.flush();
  if (!out) throw FileError(file_.string() + " cannot be written; is the disk full?");
  pending_.clear();
}

}  // namespace pipelines
