/// Shafts and drums as bodies of revolution: which of them are, and what they are as such.
#pragma once

#include <string>

#include "fem/models/axisymmetric/meridian_body.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/values/body_scene.h"

namespace pipelines {

/// The body with blocks as coarse as they can be, 2 cells on every fillet quarter: the section's cells are
/// cut where stress asks for it.
/// @param body  a shaft or drum
BodyScene with_coarse_blocks(const BodyScene& body);

/// The half section of the body's blocks, with the boundary ids of the solid's mesh. Eccentric segments are
/// concentric, and named as eccentric.
/// @param mesh  of the same body: its fillets
/// @throws std::invalid_argument as meshes::build_half_section
fem::MeridianBody meridian_body(const BodyScene& body, const meshes::BodyMesh& mesh);

/// The body without cells and model: ports, features, sections and sharp edges, exact masses.
/// Its sections are lines of the cells of the coarse blocks.
/// @throws std::invalid_argument with the body's origin, as meshes::build_shaft
MeshedBody describe_revolved(const BodyScene& body);

}  // namespace pipelines
