/// The cheapest model of chambers: a thin cylindrical tube with plates welded to its outside, loaded through
/// the plates. Milliseconds. Eigen in the .cc file only, no deal.II.
///
/// Conventions: tube along z; angles about its axis from +x, counter-clockwise; radial displacement and
/// traction positive outwards; stress on the tube's outside, tensile positive, xx, yy, zz, xy, yz, xz.
#pragma once

#include <array>
#include <vector>

#include "fem/base/values/body.h"

namespace fem {

/// A plate across the tube's axis, welded to an arc of its outside.
struct TubePlate {
  double middle_rad = 0, half_angle_rad = 0;
  double z_m = 0;  ///< of its mid-plane
  double thickness_m = 0;
};

struct PlatedTube {
  double outer_radius_m = 0, wall_m = 0;
  double begin_m = 0, end_m = 0;  ///< z of the rings that keep the tube round
  Material material;
  std::vector<TubePlate> plates;
};

/// A point of the outside.
struct TubePoint {
  double angle_rad = 0, z_m = 0;
};

/// What a plate passes on to the tube.
enum class PlateLoad { fx, fy, torque };  ///< 1 N through the tube's axis; 1 N m about it
inline constexpr int n_plate_loads = 3;

/// Stress at the points for each unit load of each plate [Pa].
///
/// The tube is a thin shell on diaphragms at both ends (round, free to warp and to turn): a double Fourier
/// series with the equation of Morley (1959), exact for rings under loads that do not vary along z, for the
/// tube as a beam between its ends, and for local bending (Bijlaard 1955 loaded such a shell with patches).
/// Plates are rigid in their plane: every plate's radial traction is such that its arc moves as a whole,
/// while its tangential traction is even and carries the torque. A traction is constant over pieces of the
/// arc, short at its ends, where it concentrates, but not below the wall's thickness, since nothing shorter
/// is thin-shell theory. Loads of tangential traction count by the radial ones of equal work on motions
/// without hoop strain. Shear along the shell, and what else loads the tube (pressure inside, its own
/// inertia), are not in it.
/// @return points x plates x n_plate_loads, the last index fastest
/// @throws std::invalid_argument for sizes that are not positive, a wall above 0.3 of the radius, plates
/// outside the tube
std::vector<std::array<double, 6>> plated_tube_stress_Pa(const PlatedTube& tube,
                                                         const std::vector<TubePoint>& points);

/// Estimate of the error of a hot-spot stress, relative. On the laboratory mill's chamber the shell has 32
/// MPa where solids have 41: rigid plates and pieces of one wall are crude where stress peaks.
inline constexpr double plated_tube_error = 0.5;

}  // namespace fem
