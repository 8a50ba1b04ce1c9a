/// The fields of a shaft's sections, seats and torsion, each declared once.
#pragma once

#include <cstdint>
#include <string>

#include "pipelines/base/fields/field.h"
#include "pipelines/judge/figures/diagrams.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/judge/stages/start_up_stress.h"

namespace pipelines {

struct SectionRow {
  const SectionResult& section;
  std::int32_t instant;  ///< instant of the body's peak
};

/// Section planes: diagrams.csv.
FieldTable<SectionRow> section_fields();

/// Torsion at the same planes: torsion.csv.
FieldTable<SectionRow> torsion_fields();

/// Fields of bodies.<body>.seats.<port>.
FieldTable<SeatMotion> seat_fields();

/// Torques of a train's elements on the shaft: bodies.<body>.torsion.elements.<element>.
FieldTable<ElementTorsion> element_torque_fields();

/// Stress at the ring next to the element's port, there too.
FieldTable<ElementTorsion> element_stress_fields();

/// A figure of a start beside steady running, which belongs to one of the three below.
struct StartUpRow {
  const StartUpFigure& figure;
  std::string unit;  ///< SI unit of the figure
  const StartUpStress* peak = nullptr;
  const StartUpRing* ring = nullptr;
  const StartUpElement* element = nullptr;
};

/// Fields of bodies.<body>.start_up: peak_von_mises, torsional_stress, elements.<element>.
FieldTable<StartUpRow> start_up_fields();

/// Fields that peak_von_mises has besides.
FieldTable<StartUpRow> start_up_peak_fields();

}  // namespace pipelines
