/// A shaft's seats, and its torsion in a drive train, in steady running and over a start: in the terminal, in
/// summary.json, and as element_torques.csv and start_up.csv. Sections: diagrams.csv, torsion.csv,
/// torsion_cycle.csv.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/judge/texts/run_report.h"

namespace pipelines {

/// Deflection and slope at the seats.
/// @param seats  bodies.<body>.seats
ShownRows shown_seats(const summary::Json& seats);

/// What bodies.<body>.seats has; null without any.
summary::Json seats_json(const Diagrams& diagrams);

/// @param analysis  with section diagrams
void write_diagrams(const std::filesystem::path& file, const Judged& analysis);

/// torsion.csv, and torsion_cycle.csv: over the instants, at the middle one of the sections of each segment.
/// @param analysis  with section diagrams
void write_torsion(const std::filesystem::path& directory, const kinetics::LoadHistory& loads,
                   const Judged& analysis);

/// Torques of the elements beside those of the stress field, torsional stress with its static and oscillating
/// part; nothing for other bodies.
void print_element_torsion(std::ostream& out, const RunReport& report, const Judged& analysis);

/// The same two tables from bodies.<body>.torsion.elements.
ShownRows shown_element_torques(const summary::Json& elements);
ShownRows shown_element_stresses(const summary::Json& elements);

/// What bodies.<body>.torsion.elements has; null for other bodies.
summary::Json element_torsion_json(const RunReport& report, const Judged& analysis);

/// Writes for each element, over the instants: torque, the same by the stress field, nominal torsional
/// stress, and that at the ring stressed most. Writes nothing for other bodies.
void write_element_torsion(const std::filesystem::path& file, const kinetics::LoadHistory& loads,
                           const Judged& analysis);

/// The start beside steady running; nothing where the scene asks for none.
void print_start_up(std::ostream& out, const Judged& analysis);

/// The same from bodies.<body>.start_up.
ShownRows shown_start_up(const summary::Json& start_up);

/// What bodies.<body>.start_up has.
summary::Json start_up_json(const Judged& analysis);

/// Writes over the start: angle and speed of the drive, torque of each element, torsional stress at the ring
/// stressed most.
/// @param analysis  with a start
void write_start_up(const std::filesystem::path& file, const Judged& analysis);

}  // namespace pipelines
