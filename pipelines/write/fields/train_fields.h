/// The fields of a drive train in torsion, each declared once.
#pragma once

#include <string>

#include "pipelines/base/fields/field.h"
#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/judge/verdict/torsion_report.h"

namespace pipelines {

struct TrainMode {
  double frequency_rad_s;
  std::string softest;  ///< "82 % in belt", where it is known
};

/// Natural frequencies: torsion.natural_frequencies.
FieldTable<TrainMode> train_mode_fields();

/// Torques in the steady state: torsion.elements.<element>.
FieldTable<ElementTorque> train_element_fields();

/// Each excitation frequency against the natural frequency nearest to it: margins.csv, torsion.margins.
FieldTable<LineMargin> margin_fields();

summary::Json train_elements_json(const TorsionReport& report);

/// Closest first.
summary::Json margins_json(const TorsionReport& report);

/// Those near a natural frequency or felt, at least the closest one; the rest is counted.
/// @param margins  torsion.margins of summary.json
ShownRows shown_margins(const summary::Json& margins, bool all = false);

/// "and 20 more, farther than ...", how many margins a table of so many rows leaves out; empty: none.
std::string margins_left_out(std::size_t n_margins, std::size_t n_shown);

/// "unbalance, order 2"
std::string line_name(const kinetics::ExcitationLine& line);

}  // namespace pipelines
