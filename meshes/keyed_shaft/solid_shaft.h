/// Shafts with keyways, which no blocks can follow: solids meshed with quadratic tetrahedra.
#pragma once

#include <string>
#include <vector>

#include "meshes/keyed_shaft/keyway.h"
#include "meshes/shaft_layout/shaft_geometry.h"
#include "meshes/solids/solid_control.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

/// What build_solid_shaft refuses before it meshes.
/// @throws GeometryRefused as build_solid_shaft
void check_solid_shaft(const Shaft& shaft, const std::vector<Keyway>& keyways, const SolidControl& control);

/// About how many tetrahedra build_solid_shaft makes, as meshes/solids/cell_estimate.h reckons: by the
/// shaft's volume, and the curvature of its cylinders and fillets; keyways are left out.
double estimated_cells(const Shaft& shaft, const SolidControl& control);

/// Meshes the shaft with its keyways. Ports, and features of cylinders, fillets, shoulders, end faces and
/// bores, are named and lie as build_shaft's; what a keyway leaves of a seat is the port. Keyway surfaces are
/// "keyway <segment>", further ones on the segment "keyway <segment> 2" ... The bore has one diameter from
/// end to end. Volume: "shaft". Sharp edges: shoulders without fillet and the floors of keyways.
/// @throws GeometryRefused with the offending numbers: as build_shaft for the shaft; a bore that is not
/// the same everywhere; a keyway on no segment, wider than 0.6 of the diameter, shallower than its own edges
/// or so deep that less than a tenth of the diameter is left to the axis or the bore, out of the bare
/// cylinder of its segment (only square ends may run out at the shaft's ends), with round ends on less than
/// its width, or one that meets another
/// @throws MeshRefused if the worst cell is below control.min_scaled_jacobian
BodyMesh build_solid_shaft(const Shaft& shaft, const std::vector<Keyway>& keyways,
                           const SolidControl& control);

}  // namespace meshes
