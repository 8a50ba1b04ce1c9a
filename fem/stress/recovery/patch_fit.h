/// Least-squares fit of polynomials to scattered samples of one patch. Internal to fem.
#pragma once

#include <Eigen/Dense>

#include "fem/mesh/grid/cell_geometry.h"

namespace fem {

/// Where the samples and targets of a patch lie, in coordinates along the lines of its mesh.
struct PatchPoints {
  Points samples, targets;
  int angle_axis =
      -1;  ///< the coordinate that is an angle [rad] from the patch's centre, within (-pi/2, pi/2); -1: none
};

/// Matrix that takes the values at the samples to the values of their fit at the targets (targets x samples).
/// Polynomials of the coordinates, scaled to the patch: the tensor-product space of `degree` if the patch is
/// a full one, else (or if the samples do not determine it) the complete space of `degree`, that without
/// the highest powers of one or two coordinates, then lower ones down to the mean. Of an angle t the powers
/// are 1, sin t, 1 - cos t, sin t (1 - cos t): the harmonics 0 and 1 are in the space exactly.
Eigen::MatrixXd fit_operator(int degree, bool full_patch, const PatchPoints& points);

/// The same in the complete space of `degree` alone; an empty matrix if the samples do not determine it well.
/// Squared errors count as exp(-concentration (d / largest d)^2), d the distance from the patch's centre.
Eigen::MatrixXd complete_fit(int degree, double concentration, const PatchPoints& points);

}  // namespace fem
