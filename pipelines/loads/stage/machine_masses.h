/// Masses that the load stage and the mesh have to agree on: each is counted once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// One figure of the load stage beside the same from mesh and added masses.
struct MassFigure {
  std::string body, name, unit;  ///< "chamber", "structure mass", "kg"
  double given = 0, mesh = 0;    ///< sizes of vectors
  double difference = 0;         ///< size of given - mesh
  double reference = 0;          ///< what it is a share of
  std::string port;              ///< port that carries it
  bool from_mesh = false;        ///< the scene left it to the mesh
  double share() const;          ///< difference / reference; 0 where there is none
};

/// Masses that move with a body without being meshed, by body: what the scene adds and what is missing.
struct Attached {
  std::vector<AttachedMass> structure, exciter;  ///< other bodies than a chamber: all in `structure`
};

struct MassAgreement {
  Machine machine;  ///< with the mesh's masses where the scene leaves them open
  std::map<std::string, Attached> attached;
  std::vector<MassFigure> figures;
};

/// Takes open masses from the meshes; differences to given ones become attached masses, which may be
/// negative, on the body's difference port.
/// @param bodies  in the order of scene.bodies
/// @throws StageRefused if a difference exceeds 20 %
MassAgreement agree_masses(const Scene& scene, const std::vector<MeshedBody>& bodies);

}  // namespace pipelines
