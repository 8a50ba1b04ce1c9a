/// How far round a cylinder touches the hole that it is pressed into.
#pragma once

namespace pipelines {

/// A long cylinder in a hole that is a little larger, without friction.
struct ConformingContact {
  double radius_m = 0;
  double clearance_m = 0;       ///< diametral, >= 0
  double force_N_m = 0;         ///< per length of the seat, > 0
  double plane_modulus_Pa = 0;  ///< E / (1 - nu^2) of the cylinder
  bool hub_is_stiff = true;     ///< else it is of the cylinder's own material
};

/// Half angle of the arc of contact [rad]: Persson's closed form for a disc in an infinite plate of the same
/// material (A. Persson, On the stress distribution of cylindrical elastic bodies in contact, Chalmers 1964),
///     E' dR / Q = (2 - ln(x + 1) - 2 x^2) / (pi x (x + 1)),  x = tan^2(half angle / 2),
/// dR half the clearance, Q the force per length. It does not exceed the arc without clearance, 84.8 degrees.
/// A stiff hub yields nothing, so that the same force presses half as far: 2 E' stands for E'. That is exact
/// for narrow arcs, where it is Hertz's contact, and within a few degrees for wide ones.
/// @throws std::invalid_argument for values out of range
double half_arc_rad(const ConformingContact& contact);

}  // namespace pipelines
