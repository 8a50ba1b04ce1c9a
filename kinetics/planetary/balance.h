/// Equilibrium of the drum, effect by effect.
#pragma once

#include <vector>

#include "kinetics/planetary_effects/effect.h"
#include "kinetics/values/load_history.h"

namespace kinetics::planetary {

/// Load history of any machine, buildable or not. Every effect is evaluated once per block of instants.
/// @param effects  in the order of summation, made for this machine
LoadHistory balance(const Machine& machine, const std::vector<NamedEffect>& effects, const TimeGrid& grid);

/// Adds quantities and warnings to a history that has its resultants.
/// @param moment_Nm  M_A: moment of the charge about A, which belt or drive couple balance
void write_results(const Machine& machine, const Eigen::ArrayXd& moment_Nm, LoadHistory& history);

}  // namespace kinetics::planetary
