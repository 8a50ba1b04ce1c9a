/// The largest size of a stress over its cycle, between the instants too.
#pragma once

#include <Eigen/Core>

#include "pipelines/superpose/between_instants/factor_spectrum.h"

namespace pipelines {

/// A row for each of the five coordinates of deviatoric_coordinates.h.
/// @param stress  (xx, yy, zz, xy, yz, xz) x anything
Eigen::Array<double, 5, Eigen::Dynamic> deviatoric_coordinates(
    const Eigen::Matrix<double, 6, Eigen::Dynamic>& stress);

/// The largest 2-norm of a curve, and what it may be beyond that.
struct CycleExtreme {
  double value = 0;       ///< largest value of the curve interpolated
  double unresolved = 0;  ///< by how much the true one may exceed it; 0: the instants resolve the curve
  double instant = 0;     ///< where it is: i + share of the step to the next one
};

/// Extreme of the trigonometric polynomial of the lines: its squared norm is one of twice the degree, whose
/// largest value is found to rounding. Intervals where bounds of the derivatives leave room for a larger one
/// are halved until they do not, or are concave; there Newton's iteration finds the crest.
/// @param spectrum  at most `most_lines` lines
CycleExtreme extreme_of_polynomial(const FactorSpectrum& spectrum);
inline constexpr Eigen::Index most_lines = 2048;

/// Extreme of polynomials through eight instants around each interval. What they leave unresolved is twice
/// what eight instants at twice the distance miss the one in their middle by, around the interval where that
/// matters most. A window whose ends do not meet is not taken as a cycle: polynomials near its ends are of
/// its own instants.
/// @param values  rows x n, n >= 16
CycleExtreme extreme_of_pieces(const Eigen::ArrayXXd& values);

/// Whether series go on at the first instant as they end: false where the cubics through the four instants on
/// either side of the seam both miss the next one by more than four times what they do elsewhere.
/// @param values  rows x n, n >= 16
bool is_closed(const Eigen::ArrayXXd& values);

}  // namespace pipelines
