/// Where the line of a segment lies on its faces: at the radius where an eccentric shift begins, or at the
/// radius of the wider bore next door, from where its rows run on into the thinner wall.
#pragma once

#include "meshes/shaft_layout/shaft_layout.h"

namespace meshes {

/// The fan of this junction has to stay above this radius: base, or a line that runs below the fan.
double radius_below_fan(const ShaftLayout& layout, int junction);

/// Fills line_begin_m and line_end_m.
/// @throws GeometryRefused if a line would have to climb too steeply from a bore step to a shoulder
void set_lines(ShaftLayout& layout);

}  // namespace meshes
