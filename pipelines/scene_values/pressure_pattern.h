/// How pressure is spread round a seat, a bore or a wall, as Fourier harmonics about the direction of the
/// force.
#pragma once

#include <vector>

#include "pipelines/common/constants.h"

namespace pipelines {

/// p(t) for the angle t from the zone's centre; zero outside |t| < half_angle.
struct PressurePattern {
  enum class Kind {
    /// cos t - cos(half_angle), what a rigid pin does to an elastic bed: half angle below 90 degrees with
    /// clearance, above it with interference; 90 degrees is the one-sided half-cosine, 180 a pressure all
    /// round
    cosine,
    uniform,  ///< a belt over its arc of wrap
  };
  Kind kind = Kind::cosine;
  double half_angle_rad = pi / 2;  ///< (0, pi]; uniform: below pi, a full ring has no resultant
};

/// What a port's pressure looks like.
struct PressureModel {
  PressurePattern pattern;
  int highest_harmonic = 4;                ///< of the pattern, as loads; 0 to 64
  std::vector<double> axial_profile{1.0};  ///< as fem::LoadSurface::axial_profile
};

/// Where the resultant of such a profile acts, in half lengths of the seat from its middle; 0 of one that is
/// symmetrical to rounding.
double middle_of(const std::vector<double>& axial_profile);

/// p_n / p_1 of the pattern's harmonics p(t) = sum of p_n cos(n t).
/// @throws std::invalid_argument for n < 0 or a half angle out of range
double pattern_coefficient(const PressurePattern& pattern, int n);

}  // namespace pipelines
