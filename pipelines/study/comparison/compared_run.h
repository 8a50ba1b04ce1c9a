/// What `compare` takes of one run: figures with what they may be, and the keys of its scene.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/fields/json_values.h"

namespace pipelines {

/// Parts of a comparison, in the order in which people read them.
enum class FigureGroup { margin, headline, place, load, cost };

std::string to_string(FigureGroup group);

/// A figure of summary.json and the bounds that its stated error gives it, all in its SI unit.
struct FigureValue {
  double value = 0, least = 0, most = 0;
};

struct RunFigure {
  FigureGroup group = FigureGroup::headline;
  std::string name;  ///< "shaft: zone at fillet body_1/eccentric_seat"; figures of one name are told by place
  std::string unit;
  FigureValue value;
  std::optional<std::array<double, 3>> position_m;
};

struct ComparedRun {
  std::filesystem::path directory;
  std::string name;                               ///< as given on the command line
  std::string headline;                           ///< of the verdict: "NOT OK: welds at web 2, lower edge"
  std::map<std::string, std::string> judgements;  ///< of each part of the verdict
  std::map<std::string, std::string> keys;        ///< of the scene, each with its text
  std::vector<std::string> bodies;
  std::vector<RunFigure> figures;
};

/// @param summary  of a run (summary.json)
/// @throws nlohmann::json::exception if it lacks what every run has
ComparedRun compared_run(const summary::Json& summary);

/// The results of a run that is complete.
/// @param name  for people
/// @throws OptionError naming the file and the remedy if the directory holds no results of a run, or if files
/// were changed since
ComparedRun read_compared_run(const std::filesystem::path& directory, const std::string& name);

}  // namespace pipelines
