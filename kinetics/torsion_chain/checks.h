/// What a drive train must fulfil before anything is computed from it.
#pragma once

#include <Eigen/Core>
#include <string>

#include "kinetics/drive_train.h"

namespace kinetics::torsion {

/// Position of the inertia of that name.
/// @param asked_by  what names it, for the message
/// @throws MachineRefused with the nearest known name
Eigen::Index inertia_at(const DriveTrain& train, const std::string& name, const std::string& asked_by);

/// Checks every number and name of inertias, elements and train; not the shape of the tree (see reduced.h).
/// @throws MachineRefused naming parameter, value and remedy
void check_parameters(const DriveTrain& train);

/// Checks the excitations.
/// @throws MachineRefused naming parameter, value and remedy
void check_excitations(const DriveTrain& train);

/// @throws MachineRefused for a name that drive_train_effects does not list or that is given twice
void check_effects(const DriveTrain& train, const std::vector<std::string>& effects);

}  // namespace kinetics::torsion
