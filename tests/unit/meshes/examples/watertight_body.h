/// What every finished mesh has to be.
#pragma once

#include "meshes/values/body_mesh.h"

/// Each free face of a cell in exactly one boundary group, no face shared by more than two cells, no loose
/// node, quads outward, counts as the body says.
void expect_watertight(const meshes::BodyMesh& body);
