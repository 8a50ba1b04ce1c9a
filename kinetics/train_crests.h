/// What lies between the instants of a train's steady state where these cannot tell its fastest harmonics.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/drive_train.h"

namespace kinetics {

/// The loads at instants between those of the grid at which an element's torque is larger than at any of the
/// grid, where harmonics with two instants per period or fewer bring more than 0.1 % of an element's torque:
/// the instants meet these always at the same places, and nothing in their values tells. Twenty-four in a
/// period of the fastest such harmonic; of many those that exceed most, ascending. Empty: the instants tell
/// all harmonics that count, or miss nothing.
/// @throws MachineRefused as compute_loads
std::optional<LoadHistory> loads_between_instants(const DriveTrain& train,
                                                  const std::vector<std::string>& effects,
                                                  const TimeGrid& grid, Eigen::Index most = 4096);

}  // namespace kinetics
