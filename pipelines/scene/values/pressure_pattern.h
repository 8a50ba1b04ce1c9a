/// How pressure is spread round a seat, a bore or a wall, as Fourier harmonics about the direction of the
/// force.
#pragma once

#include <optional>
#include <vector>

#include "pipelines/base/common/constants.h"

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

/// Half angles within which that of a contact lies.
struct HalfAngles {
  double least_rad = 0, most_rad = 0;
};

/// Half angles of the load zone of a rolling bearing: 90 degrees without clearance, arccos(P_d / (2 delta_r))
/// with the diametral clearance P_d and the ring's displacement delta_r (T. A. Harris, Rolling Bearing
/// Analysis, distribution of internal loading). Stribeck's 5 F / Z for the largest load of Z elements at the
/// usual clearance, in place of 4.37 F / Z without one, belongs to 72 degrees; 40 degrees to half a clearance
/// of 3.3 times the elastic approach of the most loaded element.
inline constexpr HalfAngles load_zones{40 * pi / 180, 90 * pi / 180};

/// A half angle that the scene gives as one number is taken as known to that share of it.
inline constexpr double half_angle_share = 0.25;

/// half_angle_share less and more than the pattern's, at most all round (a uniform one: half way to that,
/// where it would lose its resultant).
HalfAngles half_angles_around(const PressurePattern& pattern);

/// What a port's pressure looks like.
struct PressureModel {
  PressurePattern pattern;
  int highest_harmonic = 4;                ///< highest harmonic of the pattern that is a load; 0 to 64
  std::vector<double> axial_profile{1.0};  ///< as fem::LoadSurface::axial_profile
  HalfAngles half_angles = load_zones;     ///< what the error for load patches looks at
  /// Diametral clearance of a solid seat in a stiff hub: pattern and half_angles follow from it and the
  /// largest force (contact_arc.h).
  std::optional<double> clearance_m;
  bool is_charge = false;  ///< a mill's charge on its wall, no contact of a ring
  /// Harmonics 2, 3 ... that the pattern has not, or that stand above highest_harmonic, are solved too, with
  /// next to no load (missing_coefficient): other half angles have them.
  bool solves_missing = false;
  /// 2 r / t of a bored seat of mean radius r and wall t: a thin ring's stress by the second harmonic over
  /// that by the mean pressure, both of the same size (R / t and 6 R r / (3 t^2)). 1: not known, or solid.
  double ring_factor = 1;
};

/// Stands in for the coefficient of a harmonic that is solved and not meant to load: a millionth of the
/// force.
inline constexpr double missing_coefficient = 1e-6;

/// p_n / p_1 that the harmonic n of a port's pressure is solved and loaded with; 0: it is not solved.
double solved_coefficient(const PressureModel& model, int n);

/// The highest harmonic that may be solved: highest_harmonic, or at least the third where the missing ones
/// are.
int highest_solved(const PressureModel& model);

/// Point where the resultant of such a profile acts, in half lengths of the seat from its middle; 0 of one
/// that is symmetrical to rounding.
double middle_of(const std::vector<double>& axial_profile);

/// p_n / p_1 of the pattern's harmonics p(t) = sum of p_n cos(n t).
/// @throws std::invalid_argument for n < 0 or a half angle out of range
double pattern_coefficient(const PressurePattern& pattern, int n);

/// p(t) / p_1, the sum of all harmonics; t in radians from the zone's centre.
double pattern_pressure(const PressurePattern& pattern, double t_rad);

}  // namespace pipelines
