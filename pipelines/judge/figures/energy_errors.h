/// What a mesh misses of a body's stress as a whole, beside the budget of the peak.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace pipelines {

/// Recovery-based estimates (fem::EnergyError), relative, in the norm of energy.
struct EnergyErrors {
  std::vector<double> channels;  ///< error of each unit load; empty where no cells were solved (cheap models)
  double over_cycle = 0;         ///< largest error at an instant over the largest stress at one
};

/// @param factors  factors of the channels (rows) over the cycle
EnergyErrors energy_errors(const fem::EnergyError& channels, const Eigen::ArrayXXd& factors);

}  // namespace pipelines
