/// Stepped shaft, solid or bored, with shoulder fillets and eccentric seats, meshed with structured
/// hexahedra; so are drums: shafts with a wide bore in the middle.
#pragma once

#include <string>
#include <vector>

#include "meshes/shaft_layout/shaft_geometry.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

/// Meshes the shaft.
/// Ports: every segment with is_port, the bore of every segment with bore_port (all of it), and the end faces
/// "end_1" (smallest z) and "end_2", which are rings where the segment is bored.
/// Features: besides those of the outside "bore <segment>", and "shoulder bore <left>/<right>" for the face
/// of a bore step. Beside a fillet, with 2 cells per quarter before subdivision, the bores of two segments
/// meet at the end of the fan nearest to the shoulder's plane instead of in it. Volumes: "core" where the
/// shaft is solid (without a chart) and "ring_<segment>". Sharp edges: every outer shoulder without a fillet
/// ("<left>/<right>", within 0.1 of the smaller diameter) and every bore step ("bore <left>/<right>", within
/// the thickness of the wall around the wider bore).
/// @throws GeometryRefused with the offending numbers: gaps, sizes that are not positive, repeated
/// names,
///         a fillet that does not fit its step (eccentric: r < (D - d)/2 - ecc) or its segment's length,
///         a port without room, an eccentricity that leaves the neighbour outside or the shifted ring flat,
///         a bore, bore step or bore_port outside what is said at Shaft, bad controls
/// @throws MeshRefused if the worst cell is below control.min_scaled_jacobian (place and value named)
BodyMesh build_shaft(const Shaft& shaft, const ShaftMeshControl& control);

}  // namespace meshes
