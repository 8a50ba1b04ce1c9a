/// The forces that a load history has, by name.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"

namespace pipelines {

/// Force of a load over the cycle [N], the role of a resultant or a quantity in newtons; empty if there is
/// none of that name.
std::optional<Eigen::ArrayXd> force_of(const std::string& load, const kinetics::LoadHistory& loads);

/// The names that force_of knows.
std::vector<std::string> known_forces(const kinetics::LoadHistory& loads);

}  // namespace pipelines
