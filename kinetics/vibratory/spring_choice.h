/// The frame's reaction as a function of the springs' common scale, and the search for its best value.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "kinetics/spring_choice.h"
#include "kinetics/vibratory_effects/mill.h"

namespace kinetics::vibratory {

/// A mill whose springs can be scaled, with what its reaction is evaluated over.
struct ScalableMill {
  VibratoryMill mill;  ///< every preload set
  std::vector<std::string> effects;
  TimeGrid grid;

  VibratoryMill scaled_by(double scale) const;
  /// R_E at the grid's instants, minus the sum of all forces on chamber and shaft [N]; 2 x n.
  Eigen::Array2Xd reaction_N(double scale) const;
  /// Largest size of the sum of elastic and damping forces over the instants, without its mean [N].
  double transmitted_N(double scale) const;
  /// dR_E / d scale with the pitch held [N]; 2 x n.
  Eigen::Array2Xd slope_N() const;
};

/// Scales at which an excited harmonic of the moment meets the natural frequency of pitch, by rising scale.
std::vector<PitchResonance> pitch_resonances(const ScalableMill& scalable, const SpringSearch& search);

/// The scale of the search with the least objective: log-spaced scan, golden section in each local minimum.
/// @param objective  infinite where it is not defined
double scan_for_least(const std::function<double(double scale)>& objective, const SpringSearch& search);

}  // namespace kinetics::vibratory
