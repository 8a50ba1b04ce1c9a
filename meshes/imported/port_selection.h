/// Which surfaces of an imported body its ports take.
#pragma once

#include <vector>

#include "meshes/imported/import.h"
#include "meshes/solids/model_mesh.h"
#include "meshes/solids/surface_pieces.h"

namespace meshes {

/// The port of every piece, by its place in `ports`; -1: none.
/// @throws GeometryRefused as build_imported
std::vector<int> assign_ports(const std::vector<ImportPort>& ports, const ModelMesh& model,
                              const std::vector<PieceShape>& shapes);

/// Values of a port that takes some of the pieces.
/// @throws GeometryRefused if a seat or bore is no cylinder parallel to z, or the material is on the
/// wrong side
Port make_port(const ImportPort& port, const ModelMesh& model, const std::vector<PieceShape>& shapes,
               const std::vector<int>& port_of_piece, int index, int boundary_id);

}  // namespace meshes
