/// Bodies as they are known before they are meshed: what `check` looks at.
#pragma once

#include <cstddef>
#include <vector>

#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/values/body_scene.h"

namespace pipelines {

/// The body without cells and model, where it can be: ports, features, hot spots, and masses that follow from
/// its measures. A shaft has its keyways' material, a chamber's plates meet the tube in straight edges: 0.2 %
/// of the mass and less. Of a STEP file the CAD kernel tells the volume, and nothing else is known: neither
/// ports nor where its mass is. A finished .msh is read with its cells, which takes an fem::Environment.
/// @param springs  as mesh_body
/// @throws meshes::GeometryRefused, meshes::MeshRefused as mesh_body, but what a mesh alone would tell
MeshedBody describe_body(const BodyScene& body, const std::vector<kinetics::Spring>& springs);

/// Whether describe_body knows its ports and where its mass is, so that loads can be distributed.
bool has_known_ports(const BodyScene& body);

/// About how many unknowns the body's mesh will have, from its measures: within a third of what is meshed,
/// tetrahedra within a factor of three. Of a STEP file the CAD kernel is asked.
std::size_t estimated_unknowns(const BodyScene& body);

}  // namespace pipelines
