/// The tables [machine...] of a scene: a drive train in torsion.
#pragma once

#include "kinetics/drive_train.h"
#include "pipelines/scene/scene.h"
#include "pipelines/scene/scene_table.h"

namespace pipelines {

/// Reads the table and closes it.
/// @param torsion  what `millstress torsion` looks at: speeds of the Campbell table, orders, convention
/// @param masses_from_mesh  takes the inertias that the scene leaves to a body's mesh
/// @return values in SI; NaN where one could not be read, with an error in the findings
kinetics::DriveTrain read_drive_train(SceneTable& machine, TorsionScene& torsion,
                                      std::vector<std::string>& masses_from_mesh);

}  // namespace pipelines
