/// Extremes of the vibratory mill's steady loads over all time, by its torus of angles.
///
/// In steady running every load is a function of phi and chi alone. Where drive and charge are incommensurate
/// their angles come arbitrarily close to every pair, so the extremes over the torus are the suprema over all
/// time; where they are commensurate, the motion is a closed line on the torus and the extremes are bounds.
/// Source: ours.
#pragma once

#include <string>
#include <vector>

#include "kinetics/vibratory_effects/mill.h"

namespace kinetics {

/// A value, and the pair of angles at which it is taken.
struct TorusPoint {
  double value = 0;
  double phi_rad = 0, chi_rad = 0;  ///< in [0, 2 pi)
};

struct TorusExtremes {
  std::string quantity, unit;
  TorusPoint least, most;
};

/// Extremes over the (phi, chi) torus of quantities of compute_loads. A grid of 72 x 72 finds the candidates:
/// loads are trigonometric polynomials of degree 3 at most, or magnitudes of such. Each of the best local
/// extremes of the grid is refined until the angles' step is 1e-8 rad. Not for phi, chi and what has poles.
/// @param quantities  names; none: R_E, B, T, theta, spring_force and the springs' forces, as far as the
///                    effects make them
/// @throws MachineRefused as compute_loads, or for a quantity that these effects do not give
std::vector<TorusExtremes> torus_extremes(const VibratoryMill& mill, const std::vector<std::string>& effects,
                                          std::vector<std::string> quantities = {});

}  // namespace kinetics
