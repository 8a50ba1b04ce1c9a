/// Least-squares fit of polynomials to scattered samples of one patch. Internal to fem.
#pragma once

#include <Eigen/Dense>

namespace fem {

using Points = Eigen::Matrix3Xd;

/// Matrix that takes the values at `samples` to the values of their fit at `targets` (targets x samples).
/// Polynomials of the affine coordinates  directions^-1 x, scaled to the patch: the tensor-product space of
/// `degree` if the patch is a full one, else (or if the samples do not determine it) the complete space of
/// `degree`, then lower ones down to the mean.
/// @param directions  columns: the patch's axes; replaced by x, y, z if nearly coplanar
Eigen::MatrixXd fit_operator(int degree, bool full_patch, const Eigen::Matrix3d& directions,
                             const Points& samples, const Points& targets);

}  // namespace fem
