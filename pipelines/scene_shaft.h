/// The tables [shaft...] of a scene: contour, material, mesh.
#pragma once

#include "pipelines/scene_table.h"

namespace pipelines {

/// Reads the table and closes it. The contour reads like the drawing, from left to right:
///   contour = [ { name = "body_1", diameter = "42 mm", length = "138.5 mm" },
///               { fillet = "2.5 mm" },
///               { port = "eccentric_seat", diameter = "60 mm", length = "60 mm" }, ... ]
/// A fillet stands between the two segments whose shoulder it rounds. A segment has either a name, or the
/// name of the port where load enters it.
/// @param mill  its eccentricity is the offset of the eccentric seat, unless the scene repeats it
/// @return values in SI; NaN where one could not be read, with an error in the findings
ShaftScene read_shaft(SceneTable& shaft, const kinetics::VibratoryMill& mill, SceneFindings& findings);

}  // namespace pipelines
