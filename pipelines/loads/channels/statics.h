/// Internal resultants of a stepped shaft by statics, from its unit loads, cylinders and fillets alone: no
/// finite elements.
#pragma once

#include <array>

#include "fem/base/values/unit_load.h"
#include "meshes/shaft_layout/shaft_geometry.h"

namespace pipelines {

/// What holds the part below the plane z in equilibrium when one unit of the load acts: the action of the
/// part above on the part below; fx, fy, fz [N], mx, my, mz [N m] about (0, 0, z).
///
/// Along a seat: fx, fy as its axial profile, less the part linear in z that makes a couple; mx, my linear in
/// z; fz and torque tapered by 1 - (2 z/b)^2. Harmonics of pressure other than the first carry nothing at any
/// z. A face carries all of its load at its height. Body forces act on the cylinders of `shaft` and the rings
/// of its fillets.
std::array<double, 6> internal_resultant(const fem::UnitLoad& load, const meshes::Shaft& shaft,
                                         double density_kg_m3, double z_m);

}  // namespace pipelines
