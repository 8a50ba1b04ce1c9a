/// The fields of fatigue, each declared once.
#pragma once

#include <optional>
#include <string>

#include "pipelines/base/fields/field.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/write/fields/body_rows.h"

namespace pipelines {

/// The worst place of each feature: fatigue.csv, bodies.<body>.fatigue.places.
FieldTable<RowOf<FatiguePlace>> fatigue_fields();

/// Weld toes: weld_fatigue.csv, bodies.<body>.fatigue.welds.
FieldTable<RowOf<WeldFatigue>> weld_fields();

/// Fillets by DIN 743: bodies.<body>.fatigue.din_743.
FieldTable<RowOf<NominalFatigue>> din_743_fields();

/// A place or weld toe among those of all bodies.
struct RankedPlace {
  std::string body, feature;
  bool is_weld = false;
  std::optional<double> life_s;       ///< none: endures
  LifeCertainty certainty;            ///< certainty of the life
  std::optional<double> utilisation;  ///< share of what is allowed; toes have none
  double error_share = 0;             ///< whole error of the stress; infinite: not known
};

/// Fields of the places of all bodies by rising life: fatigue_ranking.
FieldTable<RankedPlace> ranking_fields();

/// "12.3% (15.1%)": what a row of summary.json uses of what is allowed, and at most by its error.
std::string utilisation_of_row(const summary::Json& row);

}  // namespace pipelines
