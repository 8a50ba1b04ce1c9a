/// Circular segment of unit radius, in forms that keep their accuracy from empty to full.
///
/// Half angle gamma from 0 (empty) to pi (full); opening delta = pi - gamma. Source: (12), (13); forms: ours.
#pragma once

namespace kinetics::planetary {

struct Segment {
  double half_angle_rad = 0;  ///< gamma
  double opening_rad = 0;     ///< pi - gamma, exact where it is small and the void was given
  double filling = 0;         ///< area over that of the circle
  double sine = 0;            ///< sin gamma = sin delta, from the smaller of the two
};

/// @param half_angle_rad  0 .. pi
Segment segment_of_half_angle(double half_angle_rad);
/// @param filling  0 .. 1
Segment segment_of_filling(double filling);
/// @param void_fraction  1 - filling, 0 .. 1
Segment segment_of_void(double void_fraction);

/// Distance of the centroid from the circle's centre, (12): (4/3) sin^3 gamma / (2 gamma - sin 2 gamma).
/// Goes to 1 for an empty segment and to 0 for a full one.
double centroid_distance(const Segment& segment);

/// x - sin x without cancellation, x from 0 to pi: within 2 ulp.
double x_minus_sin(double x);

/// Solves x - sin x = 2 pi share (Kepler's equation of eccentricity one) for x from 0 to pi.
/// @param share  share of the circle's area, 0 .. 1/2
double angle_of_share(double share);

}  // namespace kinetics::planetary
