/// Fatigue of a body in the terminal, in summary.json, and as fatigue.csv.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/life/body_fatigue.h"
#include "pipelines/report_parts/json_values.h"
#include "pipelines/report_parts/run_report.h"

namespace pipelines {

/// The first places, with what brings the amplitude, and the rules; nothing where the scene does not ask.
void print_fatigue(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis);

/// A place or weld toe among those of all bodies.
struct RankedPlace {
  std::string body, feature;
  bool is_weld = false;
  std::optional<double> life_s;       ///< none: endures
  LifeCertainty certainty;            ///< of the life
  std::optional<double> utilisation;  ///< of what is allowed; toes have none
  double error_share = 0;             ///< whole error of the stress; infinite: not known
};

/// Places and weld toes of all bodies by rising life, over all operating blocks where the scene has some;
/// those that endure by the least life that their errors leave, then by falling utilisation. Empty where
/// fewer than two bodies are judged.
std::vector<RankedPlace> fatigue_ranking(const RunReport& report);

/// Rows of a ranking that are shown: the first ones, and the first of each body.
/// @param bodies  of each row
std::vector<std::size_t> rows_shown(const std::vector<std::string>& bodies, std::size_t most);

void print_shortest_lives(std::ostream& out, const RunReport& report);

/// What `fatigue_ranking` has.
summary::Json fatigue_ranking_json(const RunReport& report);

/// What bodies.<body>.fatigue has.
summary::Json fatigue_json(const RunReport& report, const BodyAnalysis& analysis);

/// All places, by falling utilisation.
void write_fatigue(const std::filesystem::path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                   const BodyAnalysis& analysis);

/// Weld toes, by rising life.
void write_weld_fatigue(const std::filesystem::path& file, const BodyAnalysis& analysis);

/// "20000 h", "3.1 h": two digits, without an exponent below a million hours.
std::string hours_text(double life_s);

/// "endures", "12000 h": of a life in seconds.
std::string life_text(const std::optional<double>& life_s);

/// The same with what the whole error of the stress leaves possible: "5000 h (4000 to 9000)", "endures;
/// 10000 h with the stated error", "endures, its error not known", "5000 h, not known well", "0.01 h, beyond
/// the S-N curve". What endures alone does so with the error added.
std::string life_text(const std::optional<double>& life_s, const LifeCertainty& certainty);

/// "1.20 (1.09)": a factor on all stresses and what their error leaves of it at least; "1.20 (-)" where the
/// error is not known, "-" where nothing changes.
std::string safety_text(double safety, double error_share);

/// least_safety for summary.json; null: not known, or nothing changes.
summary::Json least_safety_json(double safety, double error_share);

/// life_range_h: [least, most], null where one endures; null where nothing is known.
summary::Json life_range_json(const LifeCertainty& certainty);

/// beyond_sn_curve: why the curve does not hold; null: it holds.
summary::Json beyond_json(const LifeCertainty& certainty);

/// "least" and "most" of a range in hours for a table; empty: not known, or endures.
std::string life_cell(const LifeCertainty& certainty, std::optional<double> LifeRange::*end);

/// Of places by rising life: the names of those whose life may be below the first one's by the error of their
/// stress.
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
