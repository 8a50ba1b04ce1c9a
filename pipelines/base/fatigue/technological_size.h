/// Technological size factor of the FKM guideline: by how much a part of a given size is weaker than the
/// sample of the material's standard, since larger sections cool more slowly.
///
///   K_d = 1                                                                       d_eff <= d_eff,N
///   K_d = (1 - 0.7686 a_d lg(d_eff / 7.5 mm)) / (1 - 0.7686 a_d lg(d_eff,N / 7.5 mm))      above
/// and of grey cast iron K_d = 1.207 below 7.5 mm, else 1.207 (d_eff / 7.5 mm)^-0.1922. For rolled steel
/// d_eff counts up to 250 mm. Source: FKM guideline, Analytical Strength Assessment, static strength,
/// technological size factor. The guideline was not at hand as printed: a_d and d_eff,N are those that a
/// public page of a German textbook of machine elements quotes (section 3.5, fig. 3.33, p. 103); grey iron by
/// Lee, Barkey and Kang, Metal Fatigue Analysis Handbook (2012), ch. 4. Left out: steels whose constants
/// differ from text to text (nitriding steel), and those that depend on the alloy (stainless steel,
/// aluminium).
#pragma once

#include <vector>

#include "pipelines/base/fatigue/fatigue_material.h"

namespace pipelines {

/// A kind of material with its size factors.
struct SizeOfMaterial {
  const char* name;           ///< "structural steel" ...
  double reference_m = 0;     ///< d_eff,N,m: size of the standard's sample
  double tensile_factor = 1;  ///< K_d,m
  double yield_factor = 1;    ///< K_d,p
};

/// The kinds of material of a group, the least factor last; empty where the group has none here.
/// @param effective_diameter_m  d_eff > 0: of solid round sections the diameter, else 4 V / O
/// @throws std::invalid_argument if the diameter is not positive
std::vector<SizeOfMaterial> sizes_of(MaterialGroup group, double effective_diameter_m);

}  // namespace pipelines
