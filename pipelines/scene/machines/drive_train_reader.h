/// The tables [machine...] of a scene: a drive train in torsion.
#pragma once

#include "kinetics/drive_train.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

/// Reads the table and closes it.
/// @param torsion  what `millstress torsion` looks at: speeds of the Campbell table, orders, convention
/// @param masses_from_mesh  takes the inertias that the scene leaves to a body's mesh
/// @return values in SI; NaN where one could not be read, with an error in the findings
kinetics::DriveTrain read_drive_train(SceneTable& machine, TorsionScene& torsion,
                                      std::vector<std::string>& masses_from_mesh);

/// Refuses a transient with more stored instants than a body's loads have room for: 50 000, fewer for trains
/// of many elements and torques (each element's torque is kept by effect: a few hundred megabytes).
/// @param machine  the table that was read
void check_start_up_instants(SceneTable& machine, const kinetics::DriveTrain& train,
                             const TorsionScene& torsion);

/// The transient that the scene asks for, with its torques.
/// @param torsion  with a transient
kinetics::TransientRun transient_run(const TorsionScene& torsion);

}  // namespace pipelines
