/// The model error of the ends of loaded seats, where the pressure of the model ends at once.
#pragma once

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// The share of the pressure p beside its end on a smooth surface that a stress there may have beyond the
/// value that is recovered. Below the end of a strip of pressure stress depends on the direction from there
/// alone (Flamant: principal stresses (p / pi)(alpha +- sin alpha), alpha the angle under which the strip is
/// seen); von Mises stress in plane strain goes from 0 outside through 0.59 p straight below to 0.4 p inside.
/// A node takes about the mean, 0.34 p; on cells that are large beside the distance it looks from, less.
inline constexpr double share_at_load_edge = 0.3, share_of_a_node = 0.34;

/// Adds the entry `load_edges` to the model part of the peak's budget where the stress at the end of a seat's
/// pressure, or share_of_a_node of the pressure where that is more, could exceed the peak by
/// share_at_load_edge. No mesh lowers it: how the pressure of the real part ends is not known. Ends at an
/// edge of the body itself, and axial profiles that end with zero, have none.
void add_load_edge_error(Judged& analysis);

}  // namespace pipelines
