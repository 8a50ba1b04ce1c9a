/// Radii of the rows on the two faces of every segment, known before any point is made.
#pragma once

#include <vector>

#include "meshes/shaft_layout/shaft_layout.h"

namespace meshes {

using Radii = std::vector<double>;  ///< ascending, m

/// Rows in the plane of a junction. A fan has rows of its own between `below` and `above`.
struct PlaneRadii {
  Radii below;  ///< from the smaller base radius to the small surface, or to the floor of the fan
  Radii above;  ///< from the small surface, or the top of the fillet, to the big surface
};

struct RadiiPlan {
  Radii first, last;               ///< radii at the shaft's two ends
  std::vector<PlaneRadii> planes;  ///< one per junction
};

/// Rows of short segments follow what the fan at their other end prescribes, so that they run straight.
RadiiPlan plan_radii(const ShaftLayout& layout);

/// The plan with each row cut into n.
RadiiPlan subdivided(const RadiiPlan& plan, int n);

/// from + (to - from) * fractions, exact at the ends
Radii spread(double from, double to, const std::vector<double>& fractions);

/// Rows that end at a bore step: index in `below` from where they are the wide segment's.
int rows_below_step(const ShaftLayout& layout, const Junction& junction);

}  // namespace meshes
