/// A shaft that turns in two or more bearings: whirl frequencies and critical speeds of its bending.
/// Milliseconds. Eigen in the .cc file only, no deal.II.
///
/// The deflection of the axis is the complex number r = x + i y, the tilt of a section likewise, so that one
/// plane is enough for a round shaft in bearings that are as stiff in all directions:
///   M r'' - i W G r' + K r = 0,   r = q exp(i w t):   w^2 M q = K q + w W G q,                          (1)
/// W the speed of the shaft. All w are real. With w > 0 the shaft whirls forward, the way that it turns; with
/// w < 0 backward. A load of order n, which goes round n times a turn of the shaft (n < 0: the other way),
/// meets a whirl where w = n W:
///   K q = w^2 (M - G / n) q,   W = w / n;   n = 1: imbalance.                                           (2)
/// Source: Genta, Dynamics of Rotating Systems (2005), chapters on the Jeffcott rotor and on rotors with many
/// degrees of freedom (complex coordinates).
#pragma once

#include <limits>
#include <vector>

#include "fem/models/beam/beam_shaft.h"

namespace fem {

/// A rigid disc on the axis.
struct RotorDisc {
  double z_m = 0, mass_kg = 0;
  double polar_kg_m2 = 0, diametral_kg_m2 = 0;  ///< inertia about the axis; about a diameter
};

/// A bearing without mass and damping, free to tilt.
struct RotorBearing {
  double z_m = 0;
  double stiffness_N_m = std::numeric_limits<double>::infinity();  ///< in all directions; infinite: rigid
};

struct Rotor {
  std::vector<BeamSegment> segments;  ///< ascending in z, without gaps
  Material material;
  std::vector<RotorDisc> discs;
  std::vector<RotorBearing> bearings;
  int n_elements = 12;  ///< over the length; more where segments, discs and bearings divide it
};

/// w of equation (1), by size, ascending.
struct WhirlFrequencies {
  std::vector<double> forward_rad_s, backward_rad_s;  ///< both positive
};

/// The section of an eccentric segment turns about its own centre: its imbalance is no stiffness. Shear
/// coefficient of Cowper (beam_section.h). Frequencies converge from above, at least with the fourth power
/// of the length of the elements.
/// @param spin_rad_s  W, at least 0
/// @throws std::invalid_argument for a rotor without segments, with gaps or impossible sizes, a bearing or
/// disc beside the shaft, a stiffness or mass that is not positive, bearings at fewer than two places
WhirlFrequencies whirl_frequencies(const Rotor& rotor, double spin_rad_s);

/// All W of equation (2), ascending. A disc with more inertia about its axis than about a diameter has fewer
/// forward ones than the shaft has degrees of freedom.
/// @param order  n, not 0
/// @throws std::invalid_argument as whirl_frequencies, and for the order 0
std::vector<double> critical_speeds_rad_s(const Rotor& rotor, double order);

}  // namespace fem
