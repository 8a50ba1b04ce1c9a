/// Materials by their EN names: elastic constants, density, fatigue group, and minimum strengths by
/// thickness.
///
/// The standards were not at hand as printed. Strengths are the minimum values of the standards' tables as
/// makers' and dealers' data sheets quote them:
///   EN 10025-2:2004, table 7 (R_eH, R_m of hot-rolled structural steels)
///   EN 10083-2:2006, tables 5 and 6 (C35, C45, C60: +QT and +N), EN 10083-3:2006, table 8 (alloy steels
///   +QT);
///     EN ISO 683-1 and -2 have the same values. Diameters of round bars; sheets of the data sheet "Saarstahl
///     C45E" give both
///   EN 1561 (expected in the casting, by wall thickness; R_p0.1 is 0.65 R_m by its annex), EN 1563:2011,
///     tables 1 and 2, EN 10293:2005, table 2
///   EN 10088-3:2005, table 7 (bars), EN 755-2:2008 (extruded rods)
/// Elastic constants: steels EN 1993-1-1, 3.2.6 with 7850 kg/m3 of EN 1991-1-1; aluminium EN 1999-1-1, 3.2.5
/// (7075: Aluminum Association); 1.4301 EN 10088-1; castings from annexes of EN 1561 and EN 1563.
/// Left out, for want of a source with both strengths: case-hardening steels.
#pragma once

#include <string>
#include <vector>

#include "pipelines/base/fatigue/fatigue_material.h"

namespace pipelines {

/// Minimum strengths of a thickness: above that of the range before, up to this one.
struct StrengthRange {
  double up_to_m = 0;     ///< diameter of a bar or thickness of a plate or wall
  double yield_Pa = 0;    ///< R_eH, R_p0.2, of grey iron R_p0.1
  double tensile_Pa = 0;  ///< R_m
};

struct LibraryMaterial {
  std::string name;                  ///< "S355J2", "C45+N"
  std::vector<std::string> aliases;  ///< other names of the same row: "S355", "1.0577"
  std::string standard;              ///< standard of the strengths: "EN 10025-2"
  double youngs_modulus_Pa = 0, poisson_ratio = 0, density_kg_m3 = 0;
  MaterialGroup group = MaterialGroup::steel;
  std::vector<StrengthRange> ranges;  ///< by rising thickness, the first from 0 on
};

/// All materials, by kind.
const std::vector<LibraryMaterial>& material_library();

/// The material of a name or alias, without regard to case and spaces; null: there is none.
const LibraryMaterial* find_material(const std::string& name);

/// Names near to one that is not in the library, at most three: the nearest by letters, and those that it
/// begins or that begin it.
std::vector<std::string> near_materials(const std::string& name);

/// The range of a thickness; null: the standard has none so thick. @param thickness_m  positive
const StrengthRange* range_of(const LibraryMaterial& material, double thickness_m);

/// The least strengths of all ranges: for a body of unknown thickness.
const StrengthRange& weakest_range(const LibraryMaterial& material);

/// "up to 16 mm", "above 16 to 100 mm". @param range  of this material
std::string range_text(const LibraryMaterial& material, const StrengthRange& range);

}  // namespace pipelines
