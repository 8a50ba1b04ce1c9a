/// The tables [machine...] of a scene: a drive train in torsion.
#pragma once

#include <optional>
#include <string>

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

/// Refuses a transient with more stored instants than a body's loads have room for: 50 000, fewer for trains
/// of many elements and torques (each element's torque is kept by effect: a few hundred megabytes).
/// @param machine  the table that was read
void check_start_up_instants(SceneTable& machine, const kinetics::DriveTrain& train,
                             const TorsionScene& torsion);

/// The transient that the scene asks for, with its torques.
/// @param torsion  with a transient
kinetics::TransientRun transient_run(const TorsionScene& torsion);

/// Whether the steps of the transient, or its stored instants, hide its largest torques: those of an element
/// differ by more than 5 % from a run in steps of half the size or less, a fortieth of the lowest elastic
/// mode's period and of the excitations', a quarter of the times between given torques.
/// @param train       with the effects that are on
/// @param torsion     with a transient
/// @param largest_Nm  size of each element's torque over its stored instants
/// @return a warning of the element that differs most; empty: they are fine enough
/// @throws kinetics::MachineRefused as kinetics::transient and kinetics::forced_response
std::optional<std::string> coarse_transient(const kinetics::DriveTrain& train, const TorsionScene& torsion,
                                            const Eigen::ArrayXd& largest_Nm);

}  // namespace pipelines
