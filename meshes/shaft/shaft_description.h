/// What is known of a shaft before it is meshed.
#pragma once

#include "meshes/shaft_layout/shaft_geometry.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

/// The tables of build_shaft without its cells: ports, features, charts, sections and sharp edges, with the
/// same boundary ids. No quality.
/// @throws std::invalid_argument as build_shaft
BodyMesh describe_shaft(const Shaft& shaft, const ShaftMeshControl& control);

}  // namespace meshes
