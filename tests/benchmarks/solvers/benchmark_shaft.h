/// The shaft of shaft.toml at any fineness, with its twelve unit loads.
#pragma once

#include <vector>

#include "fem/base/values/unit_load.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/scene/whole/scene.h"

namespace measure {

/// How finely the shaft is meshed; the lengths of its cells follow the sectors.
struct Refinement {
  int fillet_cells = 2, sectors = 16;
  double stretch = 1;  ///< of the cells along the axis, away from fillets
};

/// @param scene  of shaft.toml
pipelines::BodyScene refined_shaft(const pipelines::Scene& scene, const Refinement& refinement);

/// fx, fy, fz, torque of every seat, in the order of the ports.
std::vector<fem::UnitLoad> seat_loads(const meshes::BodyMesh& mesh);

}  // namespace measure
