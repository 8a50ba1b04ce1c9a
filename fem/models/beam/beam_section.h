/// A cross-section of a beam: sizes and nominal stress. Internal to fem.
#pragma once

#include <Eigen/Dense>

#include "fem/models/beam/beam_shaft.h"

namespace fem {

using Wrench6 = Eigen::Matrix<double, 6, 1>;  ///< force [N], moment [N m]

/// Circle less the bore. Moments of area about the centroid.
struct BeamSection {
  double area_m2 = 0;
  Eigen::Vector2d centroid_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d moments_m4 = Eigen::Matrix2d::Zero();  ///< integrals of x x, x y, y y
  double polar_m4 = 0;
  double rim_shear = 0;  ///< shear stress on the rim where it is largest, over V / A (see beam_section)
  double shear_area_m2 = 0;

  /// Integrals of rho (p, 1) (p, 1)' that make the rigid-body mass matrix per length, about (0, 0, 0).
  Eigen::Matrix<double, 6, 6> mass_per_length(double density_kg_m3, double z_m) const;
};

/// Rim shear by Jourawski's formula, 4/3 for a full circle, 2 for a thin ring:
///   4/3 (R^2 + R b + b^2) / (R^2 + b^2).
/// Shear coefficient of Cowper (1966): 6 (1 + nu) / (7 + 6 nu) of a full circle; of a ring with m = b / R,
///   6 (1 + nu) (1 + m^2)^2 / ((7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2).
BeamSection beam_section(const BeamSegment& segment, double poisson_ratio);

/// Nominal stresses at a point of the outer surface, at the angle whose unit vector is `direction`.
struct NominalStress {
  double tension_Pa = 0, bending_Pa = 0;  ///< along z
  double shear_Pa = 0;                    ///< theta z, of torque and shear force
};

/// @param internal  action of the part above on the part below: force [N], moment about (0, 0, z) [N m]
NominalStress nominal_stress(const BeamSegment& segment, const BeamSection& section, const Wrench6& internal,
                             const Eigen::Vector2d& direction);

/// Curvatures and so on: derivatives along z of the translation (of the point on the z axis) and the rotation
/// of a section, which stays plane.
Wrench6 strain_of_section(const BeamSection& section, const Wrench6& internal, const Wrench6& motion,
                          const Material& material);

}  // namespace fem
