/// Volumes of shafts, less their bores, from their drawing alone: no mesh, none of the mesher's own code.
#pragma once

#include "meshes/shaft_layout/shaft_geometry.h"

/// Area of the regular polygon with n corners on a circle.
double polygon_area(double radius_m, int n_corners);

/// Volume of the shaft whose circles are polygons and whose fillets are chords of equal angle.
/// An eccentric segment counts as if it were centred: shifting a section does not change its area.
double polygonal_volume(const meshes::Shaft& shaft, int cells_per_fillet_quarter, int n_sectors);

/// Volume of the true shaft, with round fillets; a fillet of radius f at the radius a is
///   integral over t in [0, f] of pi r^2,  r = a + f - sqrt(f^2 - t^2)
///   = pi f ((a + f)^2 - (a + f) f pi/2 + 2 f^2 / 3)
double true_volume(const meshes::Shaft& shaft);
