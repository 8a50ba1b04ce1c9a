/// Whether a drive train's transient is followed finely enough.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "kinetics/drive_train.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

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
