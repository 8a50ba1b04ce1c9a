/// A body of the scene, meshed, with what it weighs.
#pragma once

#include <memory>
#include <vector>

#include "fem/models/solid/model.h"
#include "kinetics/vibratory_mill.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/scene/values/body_scene.h"

namespace pipelines {

struct MeshedBody {
  meshes::BodyMesh mesh;
  fem::Body body;  ///< what the model was made of
  std::shared_ptr<const fem::Model> model;
  fem::MassProperties masses;  ///< masses of the whole mesh
  fem::GeometryError geometry_error;
  /// "structure" and "exciter" of a chamber; otherwise the whole body. A chamber of one piece is all
  /// structure: its exciter is an added mass.
  std::vector<RegionMass> regions;
};

/// The mesh alone.
/// @throws meshes::GeometryRefused, meshes::MeshRefused as the mesher
meshes::BodyMesh build_mesh(const BodyScene& body);

/// Mesh, model and masses.
/// @param springs  springs of the machine, for elastic feet; empty otherwise
/// @param coarse   the same body with fewer refinements, whose mesh is taken over; none: it is meshed
MeshedBody mesh_body(const BodyScene& body, const std::vector<kinetics::Spring>& springs,
                     const MeshedBody* coarse = nullptr);

/// What fem needs of a mesh.
fem::Body to_fem_body(const meshes::BodyMesh& mesh, const fem::Material& material);

}  // namespace pipelines
