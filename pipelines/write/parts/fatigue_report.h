/// Fatigue of a body in the terminal, in summary.json, and as fatigue.csv.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/texts/run_report.h"
#include "pipelines/write/fields/fatigue_fields.h"

namespace pipelines {

/// The first places, with what brings the amplitude, and the rules; nothing where the scene does not ask.
void print_fatigue(std::ostream& out, const RunReport& report, const Judged& analysis);

/// Places and weld toes of all bodies by rising life, over all operating blocks where the scene has some;
/// those that endure by the least life that their errors leave, then by falling utilisation. Empty where
/// fewer than two bodies are judged.
std::vector<RankedPlace> fatigue_ranking(const RunReport& report);

/// Rows of a ranking that are shown: the first ones, and the first of each body.
/// @param bodies  body of each row
std::vector<std::size_t> rows_shown(const std::vector<std::string>& bodies, std::size_t most);

void print_shortest_lives(std::ostream& out, const RunReport& report);

/// What `fatigue_ranking` has.
summary::Json fatigue_ranking_json(const RunReport& report);

/// What bodies.<body>.fatigue has.
summary::Json fatigue_json(const RunReport& report, const Judged& analysis);

/// Writes all places, by falling utilisation.
void write_fatigue(const std::filesystem::path& file, const BodyResult& body);

/// Writes weld toes, by rising life.
void write_weld_fatigue(const std::filesystem::path& file, const BodyResult& body);

/// Names of the places whose life may be below the first one's by the error of their stress. The places stand
/// by rising life.
template <typename Place, typename Name>
std::vector<std::string> may_last_less(const std::vector<Place>& places, const Name& name) {
  std::vector<std::string> names;
  if (places.empty() || !places.front().life_s) return names;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const auto& range = places[i].certainty.range;
    if (range && range->least_s && *range->least_s < *places.front().life_s) names.push_back(name(places[i]));
  }
  return names;
}

/// A line for the terminal below such places; nothing where there is none.
void print_may_last_less(std::ostream& out, const std::string& first, const std::vector<std::string>& others);

}  // namespace pipelines
