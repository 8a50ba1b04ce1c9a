/// The fields of stress zones, weld toes and places, and the stresses that lead a body's report, each
/// declared once.
#pragma once

#include <string>

#include "pipelines/base/fields/field.h"
#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/judge/texts/zone_text.h"
#include "pipelines/write/fields/body_rows.h"

namespace pipelines {

/// What zones of runs and of sweeps have.
FieldTable<ZoneFigures> zone_figure_fields();

/// Fields of zones.csv, bodies.<body>.zones.
FieldTable<RowOf<Zone>> zone_fields();

/// Zones and their parts: zone_tree.csv, bodies.<body>.zones[].parts.
FieldTable<RowOf<ZonePart>> zone_part_fields();

/// Weld toes: hot_spots.csv, bodies.<body>.hot_spots.
FieldTable<RowOf<HotSpotStress>> hot_spot_fields();

/// Fields of bodies.<body>.places.
FieldTable<RowOf<PlaceStress>> place_fields();

/// The stresses that lead a body's report, as figures of bodies.<body>: each with value, place and moment.
FieldTable<BodyResult> headline_fields();

/// What people read of them: value with error, safety against yield, where and when. Those that say nothing
/// new are left out.
/// @param body  bodies.<body> of summary.json
ShownRows headline_rows(const summary::Json& body);

/// "by belt 83 %, drive 17 %; amplitude 41.9 MPa by belt 100 %", by groups, and where fatigue is asked for
/// "; damage by belt 100 %". Without shares where there is one effect; empty where nothing is known.
/// @param zone  zone of summary.json
std::string causes_of_row(const summary::Json& zone);

/// "total" of all sources, "numerical" of those that a finer run would mend, "model" of the others.
summary::Json budget_json(const ErrorBudget& budget);

}  // namespace pipelines
