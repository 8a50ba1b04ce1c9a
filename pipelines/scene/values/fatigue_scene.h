/// What a scene says of a body's fatigue. Values in SI units.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "pipelines/base/fatigue/fatigue_material.h"

namespace pipelines {

/// Weld toes of a body, by IIW's structural hot-spot stress.
struct WeldToeScene {
  std::string type = "load-carrying";  ///< weld_classes.h; empty: the class is the scene's own
  double class_Pa = 90e6;              ///< FAT: range with 95 % survival at 2e6 cycles
  double partial_factor = 1.35;        ///< gamma_M on the class
  std::string origin{};                ///< "file:line:column: key" of an entry for a single toe
};

struct FatigueScene {
  FatigueMaterial material;  ///< its tensile strength has the size factor in it
  /// "C45+N, above 16 to 100 mm, EN 10083-2": a strength of the part at its size; empty: the scene gives it.
  std::string strength_source;
  double size_factor = 1;              ///< K_d: tensile strength of the part over that of the scene
  double roughness_m = 0;              ///< R_z
  double treatment = 1;                ///< K_V: shot peening, nitriding ... raise what the surface endures
  double safety = 1.5;                 ///< j_D: on the design endurance limit
  std::string safety_reason;           ///< where the factor comes from
  double reliability = 0.975;          ///< survival of parts at the design limit
  std::optional<double> endurance_Pa;  ///< measured sigma_W instead of the group's share of R_m
  std::optional<double> wanted_life_s;
  WeldToeScene toes;                                 ///< settings of all weld toes
  std::map<std::string, WeldToeScene> toes_by_name;  ///< settings of single toes, in place of those
};

}  // namespace pipelines
