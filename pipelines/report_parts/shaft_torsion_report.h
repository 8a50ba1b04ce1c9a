/// Torsion of a shaft of a drive train, in steady running and over a start: in the terminal, in summary.json,
/// and as element_torques.csv and start_up.csv.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "pipelines/report_parts/json_values.h"
#include "pipelines/report_parts/run_report.h"

namespace pipelines {

/// Torques of the elements beside those of the stress field, torsional stress with its static and oscillating
/// part; nothing for other bodies.
void print_element_torsion(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis);

/// What bodies.<body>.torsion.elements has; null for other bodies.
summary::Json element_torsion_json(const RunReport& report, const BodyAnalysis& analysis);

/// Over the instants, of each element: torque, the same by the stress field, nominal torsional stress, and
/// that at the ring stressed most. Writes nothing for other bodies.
void write_element_torsion(const std::filesystem::path& file, const kinetics::LoadHistory& loads,
                           const BodyAnalysis& analysis);

/// The start beside steady running; nothing where the scene asks for none.
void print_start_up(std::ostream& out, const BodyAnalysis& analysis);

/// What bodies.<body>.start_up has.
summary::Json start_up_json(const BodyAnalysis& analysis);

/// Over the start: angle and speed of the drive, torque of each element, torsional stress at the ring
/// stressed most.
/// @param analysis  with a start
void write_start_up(const std::filesystem::path& file, const BodyAnalysis& analysis);

}  // namespace pipelines
