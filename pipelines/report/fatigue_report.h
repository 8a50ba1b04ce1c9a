/// Fatigue of a body in the terminal, in summary.json, and as fatigue.csv.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "pipelines/analysis/body_fatigue.h"
#include "pipelines/report/results.h"
#include "pipelines/report/summary_values.h"

namespace pipelines {

/// The first places, with what brings the amplitude, and the rules; nothing where the scene does not ask.
void print_fatigue(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis);

/// The places and weld toes of all bodies that last least, where several bodies are judged.
void print_shortest_lives(std::ostream& out, const std::vector<BodyAnalysis>& bodies);

/// What bodies.<body>.fatigue has.
summary::Json fatigue_json(const RunReport& report, const BodyAnalysis& analysis);

/// All places, by falling utilisation.
void write_fatigue(const std::filesystem::path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                   const BodyAnalysis& analysis);

/// Weld toes, by rising life.
void write_weld_fatigue(const std::filesystem::path& file, const BodyAnalysis& analysis);

/// "endures", "1.2e+04 h": of a life in seconds.
std::string life_text(const std::optional<double>& life_s);

/// The same with what the stress's error makes of it: "1.2e+04 h (8000 to 1.9e+04)".
/// @param error_share  of the stress; infinite: not known
/// @param slope        life goes with that power of stress
std::string life_range_text(const std::optional<double>& life_s, double error_share, double slope);

}  // namespace pipelines
