#include "pipelines/study/comparison/compared_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/json_file.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/files/staged_results.h"

namespace pipelines {
namespace {

using summary::Json;

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// What was put in, how a run was made, or how good its mesh is, and not what it found.
const std::vector<std::string> no_findings{"energy_error",   "geometry_error",  "error",
                                           "search",         "dropped_effects", "zone_level",
                                           "yield_strength", "safety_factor",   "size_factor"};

std::string spaced(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

/// "shaft: torsion max shear stress"
std::string joined_name(const std::string& before, const std::string& key) {
  if (before.empty()) return key;
  return before + (before.find(": ") == std::string::npos ? ": " : " ") + spaced(key);
}

FigureValue with_error(double value, double error) {
  return {value, value - error, value + error};
}

/// The error of a figure: a number or {"total"}; null is one that is not known. A stress at a place that
/// states none has one; a mass or a load has not.
double error_of(const Json& figure) {
  if (!figure.contains("error")) return figure.contains("feature") ? unbounded : 0;
  Json error = figure.at("error");
  if (error.is_object()) error = error.contains("total") ? error.at("total") : Json(0);
  return error.is_number() ? error.get<double>() : unbounded;
}

std::optional<std::array<double, 3>> position_of(const Json& row) {
  if (!row.contains("position_m") || !row.at("position_m").is_array()) return {};
  return row.at("position_m").get<std::array<double, 3>>();
}

bool is_number_at(const Json& row, const char* key) {
  return row.contains(key) && row.at(key).is_number();
}

class FigureCollector {
public:
  explicit FigureCollector(std::vector<RunFigure>& figures) : figures_(figures) {}

  void add(FigureGroup group, const std::string& name, const std::string& unit, const FigureValue& value,
           std::optional<std::array<double, 3>> position_m = {}) {
    figures_.push_back({group, name, unit, value, position_m});
  }

  /// All {"value", "unit"} below.
  void add_below(FigureGroup group, const std::string& name, const Json& json) {
    if (!json.is_object()) return;
    if (is_number_at(json, "value") && json.contains("unit")) {
      add(group, name, json.at("unit").get<std::string>(),
          with_error(json.at("value").get<double>(), error_of(json)));
      return;
    }
    for (const auto& [key, value] : json.items())
      if (std::find(no_findings.begin(), no_findings.end(), key) == no_findings.end())
        add_below(group, joined_name(name, key), value);
  }

  /// A stress of each row of a list, with its error.
  void add_stresses(const Json& rows, const std::string& name_before, const char* name_key,
                    const char* stress_key) {
    for (const auto& row : rows)
      if (is_number_at(row, stress_key))
        add(FigureGroup::place, name_before + row.at(name_key).get<std::string>(), "Pa",
            with_error(row.at(stress_key).get<double>(), is_number_at(row, "error_Pa")
                                                             ? row.at("error_Pa").get<double>()
                                                         : row.contains("error") ? error_of(row)
                                                                                 : unbounded),
            position_of(row));
  }

private:
  std::vector<RunFigure>& figures_;
};

void take_verdict(const Json& verdict, ComparedRun& run, FigureCollector& collector) {
  run.headline = verdict.at("headline").get<std::string>();
  for (const auto& [part, judged] : verdict.at("parts").items()) {
    run.judgements[part] = judged.at("judgement").get<std::string>();
    for (const auto& finding : judged.at("findings"))
      if (is_number_at(finding, "margin")) {
        const double margin = finding.at("margin").get<double>();
        const double least =
            is_number_at(finding, "margin_least") ? finding.at("margin_least").get<double>() : -unbounded;
        collector.add(FigureGroup::margin, part + ": margin of " + finding.at("criterion").get<std::string>(),
                      "1", {margin, least, margin + (margin - least)});
      }
  }
}

void take_body(const std::string& name, const Json& body, FigureCollector& collector) {
  for (const auto& [key, value] : body.items())
    if (std::find(no_findings.begin(), no_findings.end(), key) == no_findings.end())
      collector.add_below(FigureGroup::headline, name + ": " + spaced(key), value);
  if (body.contains("zones"))
    collector.add_stresses(body.at("zones"), name + ": zone at ", "feature", "peak_von_mises_Pa");
  if (body.contains("hot_spots"))
    collector.add_stresses(body.at("hot_spots"), name + ": weld toe ", "name", "von_mises_Pa");
  if (is_number_at(body, "dofs"))
    collector.add(FigureGroup::cost, name + ": unknowns", "1", with_error(body.at("dofs").get<double>(), 0));
}

/// Lives of the places that last least; none of those that endure.
void take_lives(const Json& ranking, FigureCollector& collector) {
  for (const auto& row : ranking) {
    if (!is_number_at(row, "life_h")) continue;
    const double life = row.at("life_h").get<double>();
    FigureValue value{life, 0, unbounded};
    if (row.contains("life_range_h") && row.at("life_range_h").is_array()) {
      const auto& range = row.at("life_range_h");
      if (range.at(0).is_number()) value.least = range.at(0).get<double>();
      if (range.at(1).is_number()) value.most = range.at(1).get<double>();
    }
    collector.add(FigureGroup::place,
                  row.at("body").get<std::string>() + ": life at " + row.at("feature").get<std::string>(),
                  "h", value);
  }
}

void take_loads(const Json& loads, FigureCollector& collector) {
  for (const auto& [name, load] : loads.items())
    for (const char* of : {"max", "min", "mean", "rms"})
      if (is_number_at(load, of))
        collector.add(FigureGroup::load, name + " " + of, load.at("unit").get<std::string>(),
                      with_error(load.at(of).get<double>(), 0));
}

void take_costs(const Json& timing, FigureCollector& collector) {
  double seconds = 0, gigabytes = 0;
  for (const auto& [stage, cost] : timing.items()) {
    if (is_number_at(cost, "seconds")) seconds += cost.at("seconds").get<double>();
    if (is_number_at(cost, "peak_memory_gigabytes"))
      gigabytes = std::max(gigabytes, cost.at("peak_memory_gigabytes").get<double>());
  }
  collector.add(FigureGroup::cost, "seconds of all stages", "s", with_error(seconds, 0));
  collector.add(FigureGroup::cost, "memory", "GB", with_error(gigabytes, 0));
}

}  // namespace

std::string to_string(FigureGroup group) {
  switch (group) {
    case FigureGroup::margin:
      return "margins";
    case FigureGroup::headline:
      return "figures";
    case FigureGroup::place:
      return "places";
    case FigureGroup::load:
      return "loads";
    case FigureGroup::cost:
      return "cost";
  }
  return "";
}

ComparedRun compared_run(const Json& summary) {
  ComparedRun run;
  FigureCollector collector(run.figures);
  take_verdict(summary.at("verdict"), run, collector);
  const auto& input = summary.at("input");
  if (input.contains("keys"))
    for (const auto& [key, text] : input.at("keys").items()) run.keys[key] = text.get<std::string>();
  if (input.contains("files"))
    for (const auto& [key, hash] : input.at("files").items())
      run.keys[key + ", content"] = hash.get<std::string>();
  if (summary.contains("bodies"))
    for (const auto& [name, body] : summary.at("bodies").items()) {
      run.bodies.push_back(name);
      take_body(name, body, collector);
    }
  if (summary.contains("bearings"))
    for (const auto& [name, bearing] : summary.at("bearings").items())
      collector.add_below(FigureGroup::headline, name, bearing);
  if (summary.contains("torsion")) {
    int mode = 0;
    if (summary.at("torsion").contains("natural_frequencies"))
      for (const auto& frequency : summary.at("torsion").at("natural_frequencies"))
        collector.add_below(FigureGroup::headline, "torsion: mode " + std::to_string(++mode), frequency);
  }
  if (summary.contains("fatigue_ranking")) take_lives(summary.at("fatigue_ranking"), collector);
  if (summary.contains("loads")) take_loads(summary.at("loads"), collector);
  take_costs(summary.at("timing"), collector);
  return run;
}

ComparedRun read_compared_run(const std::filesystem::path& directory, const std::string& name) {
  const auto file = directory / "summary.json";
  if (std::error_code none; !std::filesystem::exists(file, none))
    throw OptionError(name + ": holds no results of a run; give a result directory, or a scene to be run");
  finish_exchange(directory);
  if (const auto check = check_manifest(directory); check.is_mixed())
    throw OptionError(check.text(directory) +
                      ": the files are not of one run, or were changed since; run the scene again");
  const auto refuse = [&](const std::string& why) {
    throw OptionError(file.string() + ": is no summary of a run (" + why +
                      "); run the scene again with this version");
  };
  const auto json = read_json_file(file);
  if (json.is_discarded()) refuse("it is no whole JSON text");
  ComparedRun run;
  try {
    run = compared_run(json);
  } catch (const nlohmann::json::exception& error) {
    refuse(error.what());
  }
  run.directory = directory;
  run.name = name;
  return run;
}

}  // namespace pipelines
