/// The chamber of a vibratory mill cut free: all forces that act on it, inertia among them after d'Alembert.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_effects/mill.h"

namespace kinetics {

/// Effects with one cause at one place, together; a column per instant.
struct FreeBodyLoad {
  std::string name;
  Eigen::Array2Xd at_m;       ///< from E' in the chamber's rest attitude
  Eigen::Array2Xd force_N;    ///< fixed frame
  Eigen::ArrayXd couple_N_m;  ///< counter-clockwise positive
};

struct FreeBody {
  Eigen::ArrayXd time_s, phi_rad;  ///< phi clockwise
  Eigen::Array2Xd pivot_m;         ///< E' from the shaft's axis E
  /// "bearing" (B, the eccentric's force through E'), "spring 1", ...; "weight of structure", "... exciter",
  /// "... charge"; "inertia of structure" (with its pitch), "... exciter", "... charge", and
  /// "inertia of charge in pitch" at C: those that an effect brings.
  std::vector<FreeBodyLoad> loads;

  /// Sum of the forces of all loads; zero but for rounding.
  Eigen::Array2Xd force_sum_N() const;
  /// Sum of the moments of all loads about E'. With `pitch` zero but for rounding; without, what a guide has
  /// to take.
  Eigen::ArrayXd moment_sum_N_m() const;
};

/// @throws MachineRefused as compute_loads, and under `published`, which does not close
FreeBody chamber_free_body(const VibratoryMill& mill, const std::vector<std::string>& effects,
                           const TimeGrid& grid);

}  // namespace kinetics
